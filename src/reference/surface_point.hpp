#pragma once

#include "reference/epsilon.hpp"
#include "reference/ray.hpp"
#include "reference/world.hpp"

#include <optional>

namespace packtrace::reference {

/// What a ray sees of the scene where it meets it first.
template <class Real>
struct SurfacePoint {
    Real t;
    int object;
    Vec3<Real> P;
    Vec3<Real> N;  ///< unit, turned against the ray
    bool leaving;  ///< the ray comes from the inside
};

template <class Real>
[[nodiscard]] std::optional<SurfacePoint<Real>> closest_surface(const World<Real>& world,
                                                                const Ray<Real>& ray)
{
    const Hit<Real> hit =
        closest_intersection(world.bodies, ray.org, ray.dir, epsilon<Real>, infinity<Real>);
    if (!hit)
        return std::nullopt;
    const Vec3<Real> P = ray.org + hit.t * ray.dir;
    const Vec3<Real> N = outward_normal(world.bodies, hit, P);
    return SurfacePoint<Real>{hit.t, hit.object, P, turned_against(N, ray.dir),
                              dot(N, ray.dir) > 0};
}

/// The mirrored ray stays in the glass it was in.
template <class Real>
[[nodiscard]] Ray<Real> reflection_ray(const Ray<Real>& ray, const SurfacePoint<Real>& at)
{
    return {at.P, reflect_ray(-ray.dir, at.N), ray.inside};
}

}  // namespace packtrace::reference
