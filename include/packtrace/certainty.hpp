#pragma once

#include <packtrace/export.hpp>
#include <packtrace/image.hpp>
#include <packtrace/render.hpp>
#include <packtrace/renderer.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

// Which rays of a picture packets of floats are unsure of (Accuracy::exact), and why.
namespace packtrace {

/// Why single precision cannot decide about a ray, in the order of UnsureCounts:
/// - tangent: it may touch a surface or pass it by, or two hits of a surface are as good as one;
/// - order: either of two objects may come first;
/// - range: a hit may lie on either side of an end of the ray;
/// - clip: either of two pieces of one object may come first, as at the rim of a capped body;
/// - magnitude: numbers of the ray, or the scene, are beyond those that error bounds hold for.
[[nodiscard]] PACKTRACE_API const std::vector<std::string>& unsure_causes();

/// Rays traced again in double, by cause.
using UnsureCounts = std::vector<std::uint64_t>;

/// The rays of a pixel: camera, mirrored, refracted and shadow rays.
struct PixelCertainty {
    std::uint32_t rays = 0;       ///< 0 for a camera ray of a tile that can hit nothing
    std::uint32_t unsure = 0;     ///< of these, traced again in double
    std::uint32_t undecided = 0;  ///< of these, such as double cannot decide either
};

/// A ray is undecided by double if moving each of its numbers by four of double's unit roundoffs,
/// 2^-51 of itself, changes the surface that it hits first, or what is in the way of a shadow ray.
/// Eight such moves are tried.
struct Certainty {
    int width = 0;
    int height = 0;
    std::vector<PixelCertainty> pixels;  ///< row by row
    FrameCounts rays;                    ///< of the whole picture
    UnsureCounts unsure;                 ///< of these, by cause
    std::uint64_t undecided = 0;
};

/// Renders a scene in single precision to see what becomes of its rays; of the options isa, width,
/// traversal, self_hits, samples, threads and progress count. Throws std::invalid_argument for
/// other kernels than packets, for Accuracy::fast and for adaptive sampling, and as render() does.
[[nodiscard]] PACKTRACE_API Certainty find_certainty(const Scene& scene,
                                                     const RenderOptions& options = {});

/// A picture of it: red is the share of a pixel's rays that were traced again in double, blue the
/// share that double cannot decide either, both linear in [0, 1]; green is 0.
[[nodiscard]] PACKTRACE_API Image<float> certainty_picture(const Certainty& certainty);

}  // namespace packtrace
