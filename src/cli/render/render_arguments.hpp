#pragma once

#include "cli/options/common_options.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/render.hpp>

#include <optional>
#include <string>

namespace packtrace::cli {

/// `--frame`, `--frames` and the options that belong to them.
struct AnimationArguments {
    std::optional<int> frame;
    std::optional<std::string> frames;
    std::optional<std::string> shard;
    bool y4m = false;
    bool overwrite = false;
    std::string fps = "30";

    /// Whether the options want more than one picture.
    [[nodiscard]] bool many() const
    {
        return frames || y4m;
    }
};

struct RenderArguments {
    std::string scene;
    std::string output;
    std::optional<std::string> certainty;  ///< file for a picture of unsure rays
    KernelArguments kernel;
    PictureArguments picture;
    SamplingArguments sampling;
    std::optional<std::string> region;  ///< the part of the picture to render
    AnimationArguments animation;
    ImageWriteOptions write;
    bool resume = false;  ///< keep finished bands, and reuse those of an earlier run
    bool quiet = false;
};

void add_render_options(CLI::App& command, RenderArguments& arguments);

/// The render options. Throws CLI::ValidationError for options that contradict each other, and
/// ImageError if a picture cannot be written.
[[nodiscard]] RenderOptions checked_render_options(const RenderArguments& arguments);

/// Adds `--region`, which MPI jobs do not have.
void add_region_option(CLI::App& command, RenderArguments& arguments);

/// Throws CLI::ValidationError if `--region` is combined with an option that excludes it.
void check_region_options(const RenderArguments& arguments);

/// The region to render; not set without `--region`. Throws CLI::ValidationError for a region
/// outside the picture.
[[nodiscard]] std::optional<Region> region_of(const RenderArguments& arguments, const Scene& scene);

}  // namespace packtrace::cli
