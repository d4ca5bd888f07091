#pragma once

#include "reference/surfaces/bodies.hpp"

#include <algorithm>
#include <limits>

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

template <class Body, class Real>
[[nodiscard]] Real first_root_ahead(const Body& body, const Vec3<Real>& O, const Vec3<Real>& D)
{
    Real first = std::numeric_limits<Real>::infinity();
    for (const auto& root : roots_of(body, O, D))
        if (root.t > 0)
            first = std::min(first, root.t);
    return first;
}

/// The t at which a ray from inside a body leaves it; infinite where it never does.
template <class Body, class Real>
[[nodiscard]] Real leaves_at(const Body& body, const Vec3<Real>& O, const Vec3<Real>& D)
{
    return first_root_ahead(body, O, D);
}

/// A clipped quadric ends at its z range, open or capped.
template <class Real>
[[nodiscard]] Real leaves_at(const QuadricBody<Real>& quadric, const Vec3<Real>& O,
                             const Vec3<Real>& D)
{
    const Real first = first_root_ahead(quadric, O, D);
    const Real end = D.z > 0 ? (quadric.high - O.z) / D.z : (quadric.low - O.z) / D.z;
    return end > 0 ? std::min(first, end) : first;
}

template <class Real>
[[nodiscard]] Real leaves_at(const PlacedBody<Real>& body, const Vec3<Real>& O, const Vec3<Real>& D)
{
    const Vec3<Real> own_org = body.placement.point_to_own(O);
    const Vec3<Real> own_dir = body.placement.vector_to_own(D);
    return std::visit([&](const auto& surface) { return leaves_at(surface, own_org, own_dir); },
                      body.surface);
}

}  // namespace packtrace::reference
