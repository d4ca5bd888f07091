#pragma once

#include <cstdint>

#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include "cli/render/render_arguments.hpp"

namespace packtrace::cli {

/// Of a band: enough for all threads, little memory. Journals depend on it.
inline constexpr std::int64_t band_pixels = std::int64_t{1} << 18;

/// Pictures of more pixels are not held whole.
inline constexpr std::int64_t most_whole_pixels = std::int64_t{1} << 24;

/// What a picture in bands took.
struct BandTally {
    double rendering = 0.0;  ///< seconds
    double writing = 0.0;    ///< seconds, mostly while the next band renders
    CutRays cut;
    int bands = 0;
    int found = 0;  ///< of them finished by an earlier run
};

/// Renders a picture band by band into its file. Memory does not grow with its height. With
/// `--resume`, finished bands are kept beside it until it is complete, and those of an earlier run
/// are taken.
[[nodiscard]] BandTally render_bands(const RenderArguments& arguments, const Scene& scene,
                                     const RenderOptions& options);

}  // namespace packtrace::cli
