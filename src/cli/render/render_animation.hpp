#pragma once

#include "cli/render/frame_output.hpp"
#include "cli/render/render_arguments.hpp"
#include "render/frame_numbers.hpp"
#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <string>

namespace packtrace::cli {

void add_animation_options(CLI::App& command, AnimationArguments& arguments);

/// Throws CLI::ValidationError for options that contradict each other or the name of the output.
void check_animation_options(const RenderArguments& arguments);

/// Sets the scene's camera to that of a frame. Throws CLI::ValidationError if there is no such
/// frame.
void go_to_frame(Scene& scene, int frame);

/// The frames to render; all if the options name none. Throws CLI::ValidationError if the scene
/// does not have these frames.
[[nodiscard]] FrameRange frames_of(const AnimationArguments& arguments, const Scene& scene);

/// The counts and times of an animation's frames.
struct FrameTally {
    int rendered = 0;
    int skipped = 0;         ///< existed already
    int replaced = 0;        ///< rendered in place of another picture
    CutRays cut;             ///< of all frames, with the largest bound
    double rendering = 0.0;  ///< seconds, without waiting for the writer
    double writing = 0.0;    ///< seconds, mostly while the next frame renders
    double seconds = 0.0;    ///< total
};

/// Returns the numbers of the frames, one by one; not set after the last frame.
using NextFrame = std::function<std::optional<int>()>;
/// Receives the share of a frame that is done.
using ShowFrame = std::function<void(int frame, double share)>;

/// Renders the frames that do not exist yet. Each frame is written while the next one renders.
[[nodiscard]] FrameTally render_frames(const RenderArguments& arguments, const Scene& scene,
                                       RenderOptions options, FrameOutput& output,
                                       const NextFrame& next, const ShowFrame& show);

/// Prints the counts and times on standard error.
void print_tally(const std::string& output, const FrameTally& tally);

/// Renders the frames of the options, each to its own file or all to one stream.
void render_animation(const RenderArguments& arguments, const Scene& scene,
                      const RenderOptions& options);

}  // namespace packtrace::cli
