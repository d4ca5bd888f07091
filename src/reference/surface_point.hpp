#pragma once

#include "reference/ray.hpp"
#include "reference/start.hpp"

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
    Part part;

    [[nodiscard]] Hit<Real> hit() const
    {
        return {t, object, part};
    }
};

template <class Real>
[[nodiscard]] std::optional<SurfacePoint<Real>> closest_surface(const World<Real>& world,
                                                                const Ray<Real>& ray)
{
    const Start<Real> start = start_at(world, ray.left, ray.org, ray.dir);
    const Hit<Real> hit = closest_from(world.bodies, start, ray.dir, infinity<Real>);
    if (!hit)
        return std::nullopt;
    const Vec3<Real> P = point_of(hit, start, ray.dir);
    const Vec3<Real> N = outward_normal(world.bodies, hit, P);
    return SurfacePoint<Real>{
        hit.t, hit.object, P, turned_against(N, ray.dir), dot(N, ray.dir) > 0, hit.part};
}

/// The mirrored ray stays in the glass it was in.
template <class Real>
[[nodiscard]] Ray<Real> reflection_ray(const Ray<Real>& ray, const SurfacePoint<Real>& at)
{
    return {at.P, reflect_ray(-ray.dir, at.N), ray.inside, at.hit()};
}

}  // namespace packtrace::reference
