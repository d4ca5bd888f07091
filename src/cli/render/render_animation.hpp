#pragma once

#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

#include "cli/render/render_arguments.hpp"

namespace packtrace::cli {

void add_animation_options(CLI::App& command, AnimationArguments& arguments);

/// Throws CLI::ValidationError for options that contradict each other or the output's name.
void check_animation_options(const RenderArguments& arguments);

/// Moves the scene's camera to a frame. Throws CLI::ValidationError where there is no such one.
void go_to_frame(Scene& scene, int frame);

/// Renders the frames asked for, each into a file of its own or all into one stream.
void render_animation(const RenderArguments& arguments, const Scene& scene,
                      const RenderOptions& options);

}  // namespace packtrace::cli
