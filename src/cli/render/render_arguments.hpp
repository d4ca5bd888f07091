#pragma once

#include "cli/options/common_options.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/render.hpp>

#include <optional>
#include <string>

namespace packtrace::cli {

/// `--frame`, `--frames` and what belongs to them.
struct AnimationArguments {
    std::optional<int> frame;
    std::optional<std::string> frames;
    std::optional<std::string> shard;
    bool y4m = false;
    bool overwrite = false;
    std::string fps = "30";

    /// More than one picture is asked for.
    [[nodiscard]] bool many() const
    {
        return frames || y4m;
    }
};

struct RenderArguments {
    std::string scene;
    std::string output;
    std::optional<std::string> certainty;  ///< where a picture of unsure rays goes
    KernelArguments kernel;
    PictureArguments picture;
    SamplingArguments sampling;
    std::optional<std::string> region;  ///< what of the picture is rendered
    AnimationArguments animation;
    ImageWriteOptions write;
    bool resume = false;  ///< keep finished bands, and go on with those of an earlier run
    bool quiet = false;
};

void add_render_options(CLI::App& command, RenderArguments& arguments);

/// Throws CLI::ValidationError for options that contradict each other, ImageError where a picture
/// can't be written.
[[nodiscard]] RenderOptions checked_options(const RenderArguments& arguments);

/// Adds `--region`, which jobs of many ranks do not take.
void add_region_option(CLI::App& command, RenderArguments& arguments);

/// Throws CLI::ValidationError where a region can't be together with another option.
void check_region_options(const RenderArguments& arguments);

/// What of the scene's picture is rendered. Throws CLI::ValidationError for a region outside it.
[[nodiscard]] std::optional<Region> region_of(const RenderArguments& arguments, const Scene& scene);

}  // namespace packtrace::cli
