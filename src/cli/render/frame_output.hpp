#pragma once

#include "cli/render/render_arguments.hpp"
#include "cli/render/render_picture.hpp"
#include <packtrace/camera.hpp>

#include <memory>
#include <string>

namespace packtrace::cli {

/// The output of an animation's frames.
class FrameOutput {
public:
    virtual ~FrameOutput() = default;

    /// The picture that an earlier run left for a frame.
    enum class Found {
        nothing,
        other,  ///< a picture of another scene, or made with other options or another version
        same    ///< the frame
    };
    /// May be called while another thread writes another frame.
    [[nodiscard]] virtual Found find(int frame, const Camera& camera) const = 0;
    /// Call it for a frame that exists. Removes temporary files of it that killed runs left behind.
    virtual void skip(int frame) = 0;
    virtual void write(int frame, const Camera& camera, const AnyImage& image) = 0;
    /// Call it after the last frame.
    virtual void finish() = 0;
};

/// One picture file per frame, named by the pattern of `--output`. Each has its recipe.
[[nodiscard]] std::unique_ptr<FrameOutput> frame_files(const RenderArguments& arguments,
                                                       const Scene& scene,
                                                       const RenderOptions& options);

/// A YUV4MPEG2 stream: on standard output for `-`, otherwise in a file that appears when it is
/// complete.
[[nodiscard]] std::unique_ptr<FrameOutput> frame_stream(const RenderArguments& arguments);

}  // namespace packtrace::cli
