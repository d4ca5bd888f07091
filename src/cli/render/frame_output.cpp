#include "cli/render/frame_output.hpp"

#include "cli/output/output.hpp"
#include "cli/render/frame_recipe.hpp"
#include "core/atomic_file.hpp"
#include "image/y4m.hpp"
#include "render/frame_numbers.hpp"

#include <filesystem>
#include <span>
#include <system_error>

namespace packtrace::cli {
namespace {

class FrameFiles final : public FrameOutput {
public:
    FrameFiles(const RenderArguments& arguments, const Scene& scene, const RenderOptions& options)
        : pattern_(arguments.output), options_(arguments.write), recipe_(arguments, scene, options)
    {
    }

    // Pictures get their names when they are complete, so an existing file is finished.
    [[nodiscard]] Found find(int frame, const Camera& camera) const override
    {
        std::error_code error;
        if (!std::filesystem::is_regular_file(pattern_.name(frame), error))
            return Found::nothing;
        return read_recipe(pattern_.name(frame)) == recipe_.of(camera) ? Found::same : Found::other;
    }

    void skip(int frame) override
    {
        remove_left_over(pattern_.name(frame));
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

class FrameStream final : public FrameOutput {
public:
    explicit FrameStream(const RenderArguments& arguments)
        : output_(arguments.output),
          gamma_(arguments.write.gamma),
          rate_(parse_frame_rate(arguments.animation.fps).value_or(FrameRate{}))
    {
    }

    [[nodiscard]] Found find(int, const Camera&) const override
    {
        return Found::nothing;
    }

    void skip(int) override
    {
    }

    void write(int, const Camera&, const AnyImage& any) override
    {
        std::visit([this](const auto& image) { write_frame(image); }, any);
    }

    void finish() override
    {
        output_.finish();
    }

private:
    template <class Real>
    void write_frame(const Image<Real>& image)
    {
        if (!started_)
            output_.write(y4m_header(image.width, image.height, rate_));
        started_ = true;
        const Bytes frame = y4m_frame(image, gamma_);
        output_.write(std::as_bytes(std::span(frame)));
        output_.flush();
    }

    Output output_;
    double gamma_;
    FrameRate rate_;
    bool started_ = false;
};

}  // namespace

std::unique_ptr<FrameOutput> frame_files(const RenderArguments& arguments, const Scene& scene,
                                         const RenderOptions& options)
{
    auto files = std::make_unique<FrameFiles>(arguments, scene, options);
    // Check before the work, so that a wrong folder costs no time.
    check_image_writable(FramePattern(arguments.output).name(0));
    return files;
}

std::unique_ptr<FrameOutput> frame_stream(const RenderArguments& arguments)
{
    return std::make_unique<FrameStream>(arguments);
}

}  // namespace packtrace::cli
