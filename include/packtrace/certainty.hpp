#pragma once

#include <packtrace/export.hpp>
#include <packtrace/image.hpp>
#include <packtrace/render.hpp>
#include <packtrace/renderer.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

// Which rays of a picture float packets cannot decide in single precision (Accuracy::exact), and
// why.
namespace packtrace {

/// Why single precision cannot decide a ray, in the order of UnsureCounts:
/// - tangent: the ray may touch or miss a surface, or two of its hits almost coincide;
/// - order: either of two objects may be hit first;
/// - range: a hit may be inside or outside the ray interval;
/// - clip: either of two pieces of one object may be hit first, as at the rim of a capped quadric;
/// - magnitude: numbers of the ray or the scene are too large or too small for the error bounds.
[[nodiscard]] PACKTRACE_API const std::vector<std::string>& unsure_causes();

/// Rays traced again in double, one count per cause.
using UnsureCounts = std::vector<std::uint64_t>;

/// The rays of a pixel: camera, mirrored, refracted and shadow rays.
struct PixelCertainty {
    std::uint32_t rays = 0;       ///< 0 for a camera ray of a tile that can hit nothing
    std::uint32_t unsure = 0;     ///< rays traced again in double
    std::uint32_t undecided = 0;  ///< unsure rays that double cannot decide either
};

/// How many rays of a picture single and double precision cannot decide.
///
/// Double cannot decide a ray if a change of each of its numbers by four unit roundoffs of double
/// (a share of 2^-51) changes the surface that it hits first, or the occluders of a shadow ray.
/// Eight such changes are tried.
struct Certainty {
    int width = 0;
    int height = 0;
    std::vector<PixelCertainty> pixels;  ///< row by row
    FrameCounts rays;                    ///< of the whole picture
    UnsureCounts unsure;                 ///< rays traced again in double, by cause
    std::uint64_t undecided = 0;         ///< unsure rays that double cannot decide either
};

/// Renders a scene in single precision and counts the rays that are unsure. Uses the options isa,
/// width, traversal, self_hits, samples, threads and progress. Throws std::invalid_argument for the
/// scalar kernel, for Accuracy::fast and for adaptive sampling; otherwise as render() does.
[[nodiscard]] PACKTRACE_API Certainty find_certainty(const Scene& scene,
                                                     const RenderOptions& options = {});

/// A picture of the certainty. Red is the share of a pixel's rays that were traced again in double,
/// blue the share that double cannot decide either; both are linear, in [0, 1]. Green is 0.
[[nodiscard]] PACKTRACE_API Image<float> certainty_picture(const Certainty& certainty);

}  // namespace packtrace
