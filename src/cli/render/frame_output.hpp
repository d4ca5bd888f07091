#pragma once

#include "cli/render/render_arguments.hpp"
#include "cli/render/render_picture.hpp"
#include <packtrace/camera.hpp>

#include <memory>
#include <string>

namespace packtrace::cli {

/// Where the frames of an animation go.
class FrameOutput {
public:
    virtual ~FrameOutput() = default;

    /// What an earlier run left in a frame's place.
    enum class Found {
        nothing,
        other,  ///< a picture made of another scene, by other options or another version
        same    ///< the frame
    };
    /// May be called while another thread writes another frame.
    [[nodiscard]] virtual Found find(int frame, const Camera& camera) const = 0;
    /// For a frame that is there. Removes what killed runs left of it besides.
    virtual void skip(int frame) = 0;
    virtual void write(int frame, const Camera& camera, const AnyImage& image) = 0;
    /// After the last frame.
    virtual void finish() = 0;
};

/// A picture file a frame, named by the pattern of `--output`. Each keeps its recipe.
[[nodiscard]] std::unique_ptr<FrameOutput> frame_files(const RenderArguments& arguments,
                                                       const Scene& scene,
                                                       const RenderOptions& options);

/// A YUV4MPEG2 stream on standard output for `-`, else in a file that appears when complete.
[[nodiscard]] std::unique_ptr<FrameOutput> frame_stream(const RenderArguments& arguments);

}  // namespace packtrace::cli
