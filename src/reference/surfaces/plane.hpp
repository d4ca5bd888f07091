#pragma once

#include "reference/surfaces/roots.hpp"
#include "reference/vec3.hpp"

namespace packtrace::reference {

template <class Real>
struct PlaneBody {
    Vec3<Real> point;
    Vec3<Real> normal;
    int object = 0;
};

/// t = n.(point - O) / n.D; infinite or NaN, which no range contains, for a parallel line.
template <class Real>
[[nodiscard]] Real intersect_ray_plane(const Vec3<Real>& O, const Vec3<Real>& D,
                                       const PlaneBody<Real>& plane)
{
    return dot(plane.normal, plane.point - O) / dot(plane.normal, D);
}

template <class Real>
[[nodiscard]] Roots<Real> roots_of(const PlaneBody<Real>& plane, const Vec3<Real>& O,
                                   const Vec3<Real>& D)
{
    Roots<Real> roots;
    roots.add({.t = intersect_ray_plane(O, D, plane),
               .part = Part::side,
               .leaving = dot(plane.normal, D) > 0});
    return roots;
}

template <class Real>
[[nodiscard]] Vec3<Real> normal_at(const PlaneBody<Real>& plane, const Vec3<Real>&, Part)
{
    return plane.normal;
}

/// The position that the surface is defined relative to.
template <class Real>
[[nodiscard]] Vec3<Real> place_of(const PlaneBody<Real>& plane)
{
    return plane.point;
}

/// A function that is 0 on the surface and has the gradient normal_at().
template <class Real>
[[nodiscard]] Real value_at(const PlaneBody<Real>& plane, const Vec3<Real>& P, Part)
{
    return dot(plane.normal, P - plane.point);
}

}  // namespace packtrace::reference
