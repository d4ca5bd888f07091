#include <cerrno>
#include <cstdio>
#include <optional>
#include <span>

#include "cli/render/frame_output.hpp"
#include "core/atomic_file.hpp"
#include "image/y4m.hpp"

namespace packtrace::cli {
namespace {

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

std::unique_ptr<FrameOutput> frame_stream(const RenderArguments& arguments)
{
    return std::make_unique<FrameStream>(arguments);
}

}  // namespace packtrace::cli
