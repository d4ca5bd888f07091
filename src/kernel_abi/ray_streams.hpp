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
};

/// Takes the hits of all rays one by one, those of a ray in no order.
template <class Real>
struct HitSink {
    void* context = nullptr;
    void (*take)(void* context, int ray, Real t, std::int32_t object,
                 const Real (&normal)[3]) = nullptr;
};

}  // namespace packtrace::abi
