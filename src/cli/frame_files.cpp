#include <filesystem>
#include <system_error>

#include "cli/frame_output.hpp"
#include "render/frame_pattern.hpp"

namespace packtrace::cli {
namespace {

class FrameFiles final : public FrameOutput {
public:
    explicit FrameFiles(const RenderArguments& arguments)
        : pattern_(arguments.output),
          options_(arguments.write),
          overwrite_(arguments.animation.overwrite)
    {
    }

    // Pictures are renamed into place when complete, so that what is there is finished.
    [[nodiscard]] bool has(int frame) const override
    {
        std::error_code error;
        return !overwrite_ && std::filesystem::is_regular_file(pattern_.name(frame), error);
    }

    void write(int frame, const Image<float>& image) override
    {
        write_image(pattern_.name(frame), image, options_);
    }

    void finish() override
    {
    }

private:
    FramePattern pattern_;
    ImageWriteOptions options_;
    bool overwrite_;
};

}  // namespace

std::unique_ptr<FrameOutput> frame_files(const RenderArguments& arguments)
{
    auto files = std::make_unique<FrameFiles>(arguments);
    // Before the work, so that a wrong folder doesn't cost it.
    check_image_writable(FramePattern(arguments.output).name(0));
    return files;
}

}  // namespace packtrace::cli
