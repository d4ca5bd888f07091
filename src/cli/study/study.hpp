#pragma once

#include "cli/render/render_arguments.hpp"
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// The functions of this folder for other commands. Builds without studies have
// cli/without_study.cpp instead, because the first four functions need observing kernels.
namespace packtrace::cli {

/// Checks before any work. Throws if `--certainty` is not possible with the other options.
void check_certainty(const RenderArguments& arguments, const RenderOptions& options);

/// Throws CLI::ValidationError if there is not enough memory for `--certainty` of this scene.
/// Unlike the picture itself, its certainty is held in memory as a whole.
void check_certainty_size(const Scene& scene);

/// Writes the picture of `--certainty`. Returns a line about it.
[[nodiscard]] std::string write_certainty(const RenderArguments& arguments, const Scene& scene,
                                          const RenderOptions& options);

/// The rays of a small picture of a scene, and how many of them single precision cannot decide.
struct UnsureSample {
    int width = 0;
    int height = 0;
    std::uint64_t rays = 0;
    std::vector<std::pair<std::string, std::uint64_t>> causes;  ///< with their unsure rays
};

/// Not set in builds without studies.
[[nodiscard]] std::optional<UnsureSample> sample_unsure(const Scene& scene, const std::string& isa);

/// Joins files of `stress --json --shard` into the JSON of `stress --json`. Throws
/// std::runtime_error if one is missing or belongs to other work.
[[nodiscard]] std::string join_stress(const std::vector<std::string>& parts);

}  // namespace packtrace::cli
