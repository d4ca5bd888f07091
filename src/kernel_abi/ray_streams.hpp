#pragma once

#include <cstdint>

// Rays given by the caller, and what they hit; arrays of any alignment, without padding.
namespace packtrace::abi {

template <class Real>
struct RaysView {
    const Real* org[3] = {};
    const Real* dir[3] = {};
    const Real* t_min = nullptr;  ///< >= 0
    const Real* t_max = nullptr;
    int count = 0;
    // Where rays start that leave hits found before, which the closest hit alone asks for: the
    // hit's point, and its surface, or where they start on the inner side of it the complement;
    // `no_start` for a ray from elsewhere. Null where none starts so.
    const Real* start_point[3] = {};
    const std::int32_t* start_surface = nullptr;
};

inline constexpr std::int32_t no_start = INT32_MIN;

/// Points that a light is looked for from: hits' own, with their surfaces; one from elsewhere has a
/// number below 0, and all are where `surface` is null.
template <class Real>
struct PointsView {
    const Real* point[3] = {};
    const std::int32_t* surface = nullptr;
    int count = 0;
};

/// Results of closest hits; `object` is -1 and `t` the ray's t_max for a miss.
template <class Real>
struct HitsView {
    Real* t = nullptr;
    std::int32_t* object = nullptr;
    Real* normal[3] = {};  ///< outward and unit; null where not wanted
    // Where rays may start from the hit on either side of the surface; null where not wanted.
    Real* outer_start[3] = {};
    Real* inner_start[3] = {};
    Real* point[3] = {};              ///< the hit's own, likewise
    std::int32_t* surface = nullptr;  ///< likewise
};

/// Takes the hits of all rays one by one, those of a ray in no order. `t` is as the search had it,
/// so that hits sort right that round to one t in `Real`.
template <class Real>
struct HitSink {
    void* context = nullptr;
    void (*take)(void* context, int ray, double t, std::int32_t object,
                 const Real (&normal)[3]) = nullptr;
};

}  // namespace packtrace::abi
