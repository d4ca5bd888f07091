#pragma once

#include <cstdint>

// Rays from the caller and their hits. Arrays have any alignment and no padding.
namespace packtrace::abi {

template <class Real>
struct RaysView {
    const Real* org[3] = {};
    const Real* dir[3] = {};
    const Real* t_min = nullptr;  ///< >= 0
    const Real* t_max = nullptr;
    int count = 0;
    // Only closest hits read these: rays that start at hits found earlier. `start_surface` is the
    // surface of that hit, or its bitwise complement for a ray that starts on the inner side, or
    // `no_start`. Null if no ray starts at a hit.
    const Real* start_point[3] = {};
    const std::int32_t* start_surface = nullptr;
};

inline constexpr std::int32_t no_start = INT32_MIN;

/// Points for which visibility of a light is asked. `surface` is the surface that a point is on, or
/// negative for a point on no surface; null if no point is on a surface.
template <class Real>
struct PointsView {
    const Real* point[3] = {};
    const std::int32_t* surface = nullptr;
    int count = 0;
};

/// Results of closest hits. For a miss, `object` is -1 and `t` is the ray's t_max.
template <class Real>
struct HitsView {
    Real* t = nullptr;
    std::int32_t* object = nullptr;
    Real* normal[3] = {};  ///< outward, unit; null if not wanted
    // Where rays that leave the hit on either side of the surface may start; null if not wanted.
    Real* outer_start[3] = {};
    Real* inner_start[3] = {};
    Real* point[3] = {};              ///< the hit itself; null if not wanted
    std::int32_t* surface = nullptr;  ///< null if not wanted
};

/// Receives the hits of all rays one by one. The hits of a ray come in no order. `t` has the
/// precision of the search, so hits whose t are equal in `Real` can still be sorted.
template <class Real>
struct HitSink {
    void* context = nullptr;
    void (*take)(void* context, int ray, double t, std::int32_t object,
                 const Real (&normal)[3]) = nullptr;
};

}  // namespace packtrace::abi
