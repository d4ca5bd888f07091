#pragma once

#include <cstdint>

// What kernels compiled with Features::probe report of one pixel, for the ray tree that
// packtrace/explain.hpp describes.
namespace packtrace::abi {

/// The path from the camera to a ray: a leading 1, then one bit per generation, 0 for a reflected
/// and 1 for a refracted ray.
using PathId = std::int64_t;
inline constexpr PathId camera_path = 1;

/// How many generations fit after the leading 1 in an integer as wide as `Real`.
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
    Real seen[3];         ///< light that a miss returns
};

/// The light of one source at a ray's hit was computed.
template <class Real>
struct ProbedLight {
    PathId path;
    std::int32_t light;    ///< index in LightingView::lights
    std::int32_t can_add;  ///< 0: the light is behind the surface, and `share` is 0
    Real share[3];
    Real color[3];
};

/// A hit was shaded.
template <class Real>
struct ProbedHit {
    PathId path;
    Real point[3];
    Real normal[3];
    Real local[3];     ///< local light of the surface
    Real at_limit[3];  ///< light added at the depth limit instead of child rays
};

/// Receiver of events. Order: a ray, its lights, its hit, its child rays.
template <class Real>
struct Probe {
    int pixel = 0;  ///< number in the tile, along its Z-order curve
    void* context = nullptr;
    void (*ray)(void* context, const ProbedRay<Real>& ray) = nullptr;
    void (*light)(void* context, const ProbedLight<Real>& light) = nullptr;
    void (*hit)(void* context, const ProbedHit<Real>& hit) = nullptr;
};

}  // namespace packtrace::abi
