#pragma once

#include "reference/glass.hpp"
#include "reference/world.hpp"

// What lies between a hit and a light, and the share of the light that passes it.
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

template <class Real>
[[nodiscard]] bool any_within(const Roots<Real>& roots, Real t_min, Real t_max)
{
    for (const auto& root : roots)
        if (root.t >= t_min && root.t <= t_max)
            return true;
    return false;
}

/// The share of a light that reaches the point of a hit: one where nothing is in the way, nothing
/// behind an opaque blocker; with transparent shadows the product of what each blocking object
/// passes on, once however often the way crosses it.
template <class Real>
[[nodiscard]] Color<Real> light_share(const World<Real>& world, const Glass<Real>& glass,
                                      const SurfacePoint<Real>& at, const WayToLight<Real>& way)
{
    Color<Real> share(1, 1, 1);
    if (world.shadows == ShadowKind::none || !way.light_casts_shadow)
        return share;
    const Start<Real> start = start_at(world, at.back().along(way.L), at.P);
    visit_bodies(world.blockers, [&](const auto& body) {
        if (!any_within(roots_from(body, start, way.L), start.t_min, way.distance))
            return true;
        const bool opaque = world.shadows == ShadowKind::opaque;
        share = opaque ? Color<Real>()
                       : share * glass.bodies[static_cast<std::size_t>(body.object)].transmittance;
        return any_positive(share);
    });
    return share;
}

}  // namespace packtrace::reference
