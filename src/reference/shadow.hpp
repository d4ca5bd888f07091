#pragma once

#include "reference/glass.hpp"
#include "reference/start.hpp"
#include "reference/world.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

// Shadow rays: the occluders between a hit and a light, and the share of the light that passes
// them.
namespace packtrace::reference {

/// The straight way from a point to a light.
template <class Real>
struct WayToLight {
    Vec3<Real> L;   ///< unit
    Real distance;  ///< infinite for a directional light
    const LightSource<Real>& light;
};

/// `light` must not be ambient.
template <class Real>
[[nodiscard]] WayToLight<Real> way_to_light(const LightSource<Real>& light, const Vec3<Real>& P)
{
    if (light.type == LightType::directional)
        return {light.unit, infinity<Real>, light};
    const Vec3<Real> v = light.vector - P;
    const Real distance = length(v);
    return {v / distance, distance, light};
}

/// The position of a light whose own place does not count as occluded: that of a point light by
/// SelfHits::exact; none for other lights.
template <class Real>
[[nodiscard]] std::optional<Vec3<Real>> place_of_light(const World<Real>& world,
                                                       const LightSource<Real>& light)
{
    if (light.type != LightType::point || world.self_hits == SelfHits::note)
        return std::nullopt;
    return light.vector;
}

/// Whether a body is hit between `start` and `start` + `t_end` D. If `light`, at the end, lies on
/// the body, the root nearest to the end does not count: rounding may put it before the end or
/// behind.
template <class Real, class Body>
[[nodiscard]] bool occludes(const Body& body, const Start<Real>& start, const Vec3<Real>& D,
                            Real t_end, const std::optional<Vec3<Real>>& light)
{
    const Roots<Real> roots = roots_from(body, start, D);
    const auto is_within = [&](const auto& root) {
        return root.t >= start.t_min && root.t <= t_end;
    };
    const auto within = std::count_if(roots.begin(), roots.end(), is_within);
    if (within == 0 || !light)
        return within != 0;
    const auto nearest =
        std::min_element(roots.begin(), roots.end(), [&](const auto& a, const auto& b) {
            return std::abs(a.t - t_end) < std::abs(b.t - t_end);
        });
    const bool at_light = value_at(body, *light, nearest->part) == 0;
    return within > (at_light && is_within(*nearest) ? 1 : 0);
}

/// Whether any of the bodies occludes.
template <class Real>
[[nodiscard]] bool any_in_way(const Bodies<Real>& bodies, const Start<Real>& start,
                              const Vec3<Real>& D, Real t_end,
                              const std::optional<Vec3<Real>>& light)
{
    bool occluded = false;
    visit_bodies(bodies, [&](const auto& body) {
        occluded = occludes(body, start, D, t_end, light);
        return !occluded;
    });
    return occluded;
}

/// The share of a light that reaches the point of a hit: 1 without an occluder, 0 behind an opaque
/// one. With transparent shadows it is the product of the occluders' transmittances; each counts
/// once, however often the ray hits it.
template <class Real>
[[nodiscard]] Color<Real> light_share(const World<Real>& world, const Glass<Real>& glass,
                                      const SurfacePoint<Real>& at, const WayToLight<Real>& way)
{
    Color<Real> share(1, 1, 1);
    if (world.shadows == ShadowKind::none || !way.light.casts_shadow)
        return share;
    const Start<Real> start = start_at(world, at.back().along(way.L), at.P);
    const auto place = place_of_light(world, way.light);
    visit_bodies(world.occluders, [&](const auto& body) {
        if (!occludes(body, start, way.L, way.distance, place))
            return true;
        const bool opaque = world.shadows == ShadowKind::opaque;
        share = opaque ? Color<Real>()
                       : share * glass.bodies[static_cast<std::size_t>(body.object)].transmittance;
        return any_positive(share);
    });
    return share;
}

}  // namespace packtrace::reference
