#pragma once

#include "cli/render/render_arguments.hpp"
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What other commands take of this folder. Builds without studies have cli/without_study.cpp in its
// place: the first four need kernels that observe themselves.
namespace packtrace::cli {

/// Throws where `--certainty` cannot be had with the other options, before any work.
void check_certainty(const RenderArguments& arguments, const RenderOptions& options);

/// Throws CLI::ValidationError where the memory for `--certainty` of this scene's picture is not
/// there. Unlike the picture itself, it is held as a whole.
void check_certainty_size(const Scene& scene);

/// Writes the picture that `--certainty` names; returns a line on it.
[[nodiscard]] std::string write_certainty(const RenderArguments& arguments, const Scene& scene,
                                          const RenderOptions& options);

/// Rays of a small picture of a scene, and those of them that single precision is unsure of.
struct UnsureSample {
    int width = 0;
    int height = 0;
    std::uint64_t rays = 0;
    std::vector<std::pair<std::string, std::uint64_t>> causes;  ///< each with its rays
};

/// Nothing in builds without studies.
[[nodiscard]] std::optional<UnsureSample> sample_unsure(const Scene& scene, const std::string& isa);

/// The JSON of `stress --json`, of files that `stress --json --shard` wrote. Throws
/// std::runtime_error where one is missing or of other work.
[[nodiscard]] std::string join_stress(const std::vector<std::string>& parts);

}  // namespace packtrace::cli
