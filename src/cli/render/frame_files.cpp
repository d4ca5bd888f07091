#include <filesystem>
#include <system_error>

#include "cli/render/frame_output.hpp"
#include "cli/render/frame_recipe.hpp"
#include "render/frame_pattern.hpp"

namespace packtrace::cli {
namespace {

class FrameFiles final : public FrameOutput {
public:
    FrameFiles(const RenderArguments& arguments, const Scene& scene, const RenderOptions& options)
        : pattern_(arguments.output), options_(arguments.write), recipe_(arguments, scene, options)
    {
    }

    // Pictures are renamed into place when complete, so that what is there is finished.
    [[nodiscard]] Found find(int frame, const Camera& camera) const override
    {
        std::error_code error;
        if (!std::filesystem::is_regular_file(pattern_.name(frame), error))
            return Found::nothing;
        return read_recipe(pattern_.name(frame)) == recipe_.of(camera) ? Found::same : Found::other;
    }

    void write(int frame, const Camera& camera, const AnyImage& image) override
    {
        options_.recipe = recipe_.of(camera);
        write_picture(pattern_.name(frame), image, options_);
    }

    void finish() override
    {
    }

private:
    FramePattern pattern_;
    ImageWriteOptions options_;
    FrameRecipe recipe_;
};

}  // namespace

std::unique_ptr<FrameOutput> frame_files(const RenderArguments& arguments, const Scene& scene,
                                         const RenderOptions& options)
{
    auto files = std::make_unique<FrameFiles>(arguments, scene, options);
    // Before the work, so that a wrong folder doesn't cost it.
    check_image_writable(FramePattern(arguments.output).name(0));
    return files;
}

}  // namespace packtrace::cli
