#pragma once

#include <memory>
#include <string>

#include <packtrace/image.hpp>

#include "cli/render_arguments.hpp"

namespace packtrace::cli {

/// Where the frames of an animation go.
class FrameOutput {
public:
    virtual ~FrameOutput() = default;

    /// The frame is there already, from an earlier run.
    [[nodiscard]] virtual bool has(int frame) const = 0;
    virtual void write(int frame, const Image<float>& image) = 0;
    /// After the last frame.
    virtual void finish() = 0;
};

/// A picture file a frame, named by the pattern of `--output`.
[[nodiscard]] std::unique_ptr<FrameOutput> frame_files(const RenderArguments& arguments);

/// A YUV4MPEG2 stream on standard output for `-`, else in a file that appears when complete.
[[nodiscard]] std::unique_ptr<FrameOutput> frame_stream(const RenderArguments& arguments);

}  // namespace packtrace::cli
