#include "cli/render/frame_output.hpp"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <system_error>

#include "cli/render/frame_recipe.hpp"
#include "core/atomic_file.hpp"
#include "image/y4m.hpp"
#include "render/frame_numbers.hpp"

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

/// Standard output, or a file that appears when complete.
class ByteSink {
public:
    explicit ByteSink(const std::string& output)
    {
        if (output != "-")
            file_.emplace(output);
    }

    void write(std::span<const std::byte> bytes)
    {
        if (file_)
            return file_->write(bytes);
        if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() ||
            std::fflush(stdout) != 0)
            throw FileError("standard output", "can't write", errno);
    }

    void finish()
    {
        if (file_)
            file_->commit();
    }

private:
    std::optional<AtomicFile> file_;
};

class FrameStream final : public FrameOutput {
public:
    explicit FrameStream(const RenderArguments& arguments)
        : sink_(arguments.output),
          gamma_(arguments.write.gamma),
          frames_per_second_(arguments.animation.fps)
    {
    }

    [[nodiscard]] Found find(int, const Camera&) const override
    {
        return Found::nothing;
    }

    void write(int, const Camera&, const AnyImage& any) override
    {
        std::visit([this](const auto& image) { write_frame(image); }, any);
    }

    void finish() override
    {
        sink_.finish();
    }

private:
    template <class Real>
    void write_frame(const Image<Real>& image)
    {
        if (!started_) {
            const std::string header = y4m_header(image.width, image.height, frames_per_second_);
            sink_.write(std::as_bytes(std::span(header)));
        }
        started_ = true;
        const Bytes frame = y4m_frame(image, gamma_);
        sink_.write(std::as_bytes(std::span(frame)));
    }

    ByteSink sink_;
    double gamma_;
    int frames_per_second_;
    bool started_ = false;
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

std::unique_ptr<FrameOutput> frame_stream(const RenderArguments& arguments)
{
    return std::make_unique<FrameStream>(arguments);
}

}  // namespace packtrace::cli
