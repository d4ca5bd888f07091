#pragma once

#include "reference/light/glass_stack.hpp"
#include "reference/start.hpp"

#include <optional>

namespace packtrace::reference {

/// A ray of the models that know glass.
template <class Real>
struct Ray {
    Vec3<Real> org;
    Vec3<Real> dir;  ///< unit
    GlassStack inside;
    Departure<Real> left = {};  ///< what it leaves; nothing for a ray from the eye
};

/// What a ray sees of the scene where it meets it first.
template <class Real>
struct SurfacePoint {
    Real t;
    int object;
    Part part;
    Vec3<Real> P;
    Vec3<Real> outward;  ///< unit normal
    Vec3<Real> N;        ///< the same, turned against the ray
    bool leaving;        ///< the ray comes from the inside

    /// Of a ray that goes back to where this one comes from.
    [[nodiscard]] Departure<Real> back() const
    {
        return {object, part, outward, leaving ? Side::inner : Side::outer};
    }
    /// Of a ray that goes on behind the surface.
    [[nodiscard]] Departure<Real> through() const
    {
        return back().towards(leaving ? Side::outer : Side::inner);
    }
};

/// What a ray from `start` along `D` meets first, up to t_max.
template <class Real>
[[nodiscard]] std::optional<SurfacePoint<Real>> closest_surface(const World<Real>& world,
                                                                const Start<Real>& start,
                                                                const Vec3<Real>& D, Real t_max)
{
    const Hit<Real> hit = closest_from(world.bodies, start, D, t_max);
    if (!hit)
        return std::nullopt;
    const Vec3<Real> P = point_of(hit, start, D);
    const Facing<Real> at = facing(world.bodies, hit, P, D);
    return SurfacePoint<Real>{hit.t, hit.object, hit.part, P, at.outward, at.turned(), at.leaving};
}

template <class Real>
[[nodiscard]] std::optional<SurfacePoint<Real>> closest_surface(const World<Real>& world,
                                                                const Ray<Real>& ray)
{
    return closest_surface(world, start_at(world, ray.left, ray.org), ray.dir, infinity<Real>);
}

/// The mirrored ray stays in the glass it was in.
template <class Real>
[[nodiscard]] Ray<Real> reflection_ray(const Ray<Real>& ray, const SurfacePoint<Real>& at)
{
    return {at.P, reflect_ray(-ray.dir, at.N), ray.inside, at.back()};
}

}  // namespace packtrace::reference
