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

/// Throws CLI::ValidationError for options that contradict each other or the output's name.
void check_animation_options(const RenderArguments& arguments);

/// Moves the scene's camera to a frame. Throws CLI::ValidationError where there is no such one.
void go_to_frame(Scene& scene, int frame);

/// The frames asked for, all when none are named. Throws CLI::ValidationError where the scene has
/// not as many.
[[nodiscard]] FrameRange frames_of(const AnimationArguments& arguments, const Scene& scene);

/// What frames took.
struct FrameTally {
    int rendered = 0;
    int skipped = 0;         ///< there already
    int replaced = 0;        ///< rendered in place of another picture
    CutRays cut;             ///< of all frames; the largest bound
    double rendering = 0.0;  ///< seconds, waiting for the writer apart
    double writing = 0.0;    ///< seconds, mostly while the next frame renders
    double seconds = 0.0;    ///< all in all
};

/// Gives the number of one frame after the other.
using NextFrame = std::function<std::optional<int>()>;
/// Is told the share of a frame that is done.
using ShowFrame = std::function<void(int frame, double share)>;

/// Renders frames that are not there yet, each written while the next ones render.
[[nodiscard]] FrameTally render_frames(const RenderArguments& arguments, const Scene& scene,
                                       RenderOptions options, FrameOutput& output,
                                       const NextFrame& next, const ShowFrame& show);

/// Says on standard error what they took.
void print_tally(const std::string& output, const FrameTally& tally);

/// Renders the frames asked for, each into a file of its own or all into one stream.
void render_animation(const RenderArguments& arguments, const Scene& scene,
                      const RenderOptions& options);

}  // namespace packtrace::cli
