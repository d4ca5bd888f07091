#pragma once

#include <cstdint>

// What kernels compiled with Features::probe report of one pixel, for the ray tree that
// packtrace/explain.hpp describes.
namespace packtrace::abi {

/// The path from the camera to a ray: a leading 1, then a bit a generation, 0 for a mirrored and
/// 1 for a refracted ray.
using PathId = std::int64_t;
inline constexpr PathId camera_path = 1;

/// How many generations fit beside the leading 1 in an integer as wide as `Real`.
template <class Real>
inline constexpr int longest_path = sizeof(Real) == 4 ? 28 : 60;

/// A ray was traced.
template <class Real>
struct ProbedRay {
    PathId path;
    Real org[3];
    Real dir[3];
    Real weight[3];
    Real t;               ///< infinite for a miss
    std::int32_t object;  ///< -1 for a miss
    Real seen[3];         ///< what a miss brings
};

/// A light was looked at from a ray's hit.
template <class Real>
struct ProbedLight {
    PathId path;
    std::int32_t light;    ///< index in LightingView::lights
    std::int32_t can_add;  ///< 0: it shines from behind, and `share` is nothing
    Real share[3];
    Real color[3];
};

/// A hit was shaded.
template <class Real>
struct ProbedHit {
    PathId path;
    Real point[3];
    Real normal[3];
    Real local[3];     ///< what the surface sends back
    Real at_limit[3];  ///< what the depth limit gives in place of children
};

/// Receiver of events. Order: a ray, its lights, its hit, the rays that go on from there.
template <class Real>
struct Probe {
    int pixel = 0;  ///< number in the tile, along its Z-order curve
    void* context = nullptr;
    void (*ray)(void* context, const ProbedRay<Real>& ray) = nullptr;
    void (*light)(void* context, const ProbedLight<Real>& light) = nullptr;
    void (*hit)(void* context, const ProbedHit<Real>& hit) = nullptr;
};

}  // namespace packtrace::abi
