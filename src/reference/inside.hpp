#pragma once

#include "reference/bodies.hpp"

namespace packtrace::reference {

/// Whether `p` is on the side of a surface that its outward normal points away from; of a
/// clipped quadric also within its z range.
template <class Real>
[[nodiscard]] bool is_inside(const SphereBody<Real>& sphere, const Vec3<Real>& p)
{
    const Vec3<Real> from_center = p - sphere.center;
    return dot(from_center, from_center) < sphere.radius * sphere.radius;
}

template <class Real>
[[nodiscard]] bool is_inside(const PlaneBody<Real>& plane, const Vec3<Real>& p)
{
    return dot(plane.normal, p - plane.point) < 0;
}

/// A sheet has no inside.
template <class Real>
[[nodiscard]] bool is_inside(const PolygonBody<Real>&, const Vec3<Real>&)
{
    return false;
}

template <class Real>
[[nodiscard]] bool is_inside(const QuadricBody<Real>& quadric, const Vec3<Real>& p)
{
    return quadric.value(quadric.point_to_canonical(p)) < 0 && quadric.low < p.z &&
           p.z < quadric.high;
}

template <class Real>
[[nodiscard]] bool is_inside(const PlacedBody<Real>& body, const Vec3<Real>& p)
{
    const Vec3<Real> own = body.placement.point_to_own(p);
    return std::visit([&](const auto& surface) { return is_inside(surface, own); }, body.surface);
}

}  // namespace packtrace::reference
