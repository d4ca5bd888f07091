#pragma once

#include "reference/world.hpp"

namespace packtrace::reference {

/// The straight way from a point to a light.
template <class Real>
struct WayToLight {
    Vec3<Real> L;  ///< unit
    Real distance;
    bool light_casts_shadow;
};

/// `light` must not be ambient.
template <class Real>
[[nodiscard]] WayToLight<Real> way_to_light(const LightSource<Real>& light, const Vec3<Real>& P)
{
    if (light.type == LightType::directional)
        return {light.unit, infinity<Real>, light.casts_shadow};
    const Vec3<Real> v = light.vector - P;
    const Real distance = length(v);
    return {v / distance, distance, light.casts_shadow};
}

}  // namespace packtrace::reference
