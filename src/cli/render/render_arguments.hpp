#pragma once

#include <optional>
#include <string>

#include <packtrace/image_io.hpp>

#include "cli/options/common_options.hpp"

namespace packtrace::cli {

/// `--frame`, `--frames` and what belongs to them.
struct AnimationArguments {
    std::optional<int> frame;
    std::optional<std::string> frames;
    std::optional<std::string> shard;
    bool y4m = false;
    bool overwrite = false;
    int fps = 30;

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
    AnimationArguments animation;
    ImageWriteOptions write;
    bool resume = false;  ///< keep finished bands, and go on with those of an earlier run
    bool quiet = false;
};

}  // namespace packtrace::cli
