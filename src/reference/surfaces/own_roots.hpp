#pragma once

#include "reference/surfaces/bodies.hpp"

#include <limits>

// Where a ray that starts on a surface meets that surface again. That the start is on it is known,
// and on which side the ray leaves: of the side's two roots one is 0, whatever rounding makes of
// the constant term, and the start is between the planes that clip, and inside the side at a cap.
namespace packtrace::reference {

/// The side of a surface that a ray leaves it on.
enum class Side { outer, inner };

/// The interior along a ray that starts on the side itself, a t² + 2 b t = 0, b having the sign of
/// the side the ray leaves on.
template <class Real>
[[nodiscard]] Interior<Real> interior_from_side(Real a, Real b, bool parallel, Side side)
{
    b = side == Side::outer ? std::abs(b) : -std::abs(b);
    if (parallel)
        return side == Side::outer ? Interior<Real>{-std::numeric_limits<Real>::infinity(), 0, true}
                                   : Interior<Real>{0, std::numeric_limits<Real>::infinity(), true};
    // From a cone's apex into either half, which holds the whole ray.
    if (b == 0 && a < 0)
        return {-std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::infinity(),
                true};
    const Real other = -2 * b / a;
    return {std::min(Real(0), other), std::max(Real(0), other), a > 0};
}

/// What `interior` must be for t = 0 to be inside or on its edge.
template <class Real>
[[nodiscard]] Interior<Real> around_start(Interior<Real> interior)
{
    auto& [first, last, between] = interior;
    if (between) {
        first = std::min(first, Real(0));
        last = std::max(last, Real(0));
    } else if (first < 0 && last > 0) {
        (-first < last ? first : last) = 0;
    }
    return interior;
}

/// The roots ahead of a start at t = 0; one that rounding put at the start lies right behind it.
template <class Real>
[[nodiscard]] Roots<Real> roots_ahead(const Roots<Real>& roots, Side side)
{
    int next = 0;
    for (int i = 0; i < roots.count; ++i)
        if (roots.root[i].t < 0 ||
            (roots.root[i].t == 0 && roots.root[i].leaving == (side == Side::outer)))
            next = i + 1;
    Roots<Real> ahead;
    for (; next < roots.count; ++next)
        ahead.add(std::max(roots.root[next].t, std::numeric_limits<Real>::min()),
                  roots.root[next].part, roots.root[next].leaving);
    return ahead;
}

template <class Real>
[[nodiscard]] Roots<Real> own_roots(const SphereBody<Real>& sphere, const Vec3<Real>& P,
                                    const Vec3<Real>& D, Part, Side side)
{
    const Interior<Real> interior =
        interior_from_side(dot(D, D), dot(P - sphere.center, D), false, side);
    return roots_ahead(clipped_roots(interior, Slab<Real>{}, false), side);
}

template <class Real>
[[nodiscard]] Roots<Real> own_roots(const PlaneBody<Real>&, const Vec3<Real>&, const Vec3<Real>&,
                                    Part, Side)
{
    return {};
}

template <class Real>
[[nodiscard]] Roots<Real> own_roots(const PolygonBody<Real>&, const Vec3<Real>&, const Vec3<Real>&,
                                    Part, Side)
{
    return {};
}

/// From a point on the side.
template <class Real>
[[nodiscard]] Roots<Real> roots_from_side(const QuadricBody<Real>& quadric, const Vec3<Real>& P,
                                          const Vec3<Real>& D, Side side)
{
    const auto [a, b, parallel] =
        line_of(quadric, quadric.point_to_canonical(P), quadric.vector_to_canonical(D));
    Slab<Real> slab = slab_of(quadric.low, quadric.high, P.z, D.z);
    slab.enter = std::min(slab.enter, Real(0));
    slab.leave = std::max(slab.leave, Real(0));
    if (D.z == 0)
        slab = {};
    return roots_ahead(
        clipped_roots(interior_from_side(a, b, parallel, side), slab, quadric.capped), side);
}

/// From a point on a cap into the body; out of it nothing is ahead.
template <class Real>
[[nodiscard]] Roots<Real> roots_from_cap(const QuadricBody<Real>& quadric, const Vec3<Real>& P,
                                         const Vec3<Real>& D, Part cap)
{
    const Interior<Real> interior = around_start(
        interior_along(quadric, quadric.point_to_canonical(P), quadric.vector_to_canonical(D)));
    const Real across = (quadric.high - quadric.low) / std::abs(D.z);
    const Slab<Real> slab{0, across, cap, cap == Part::low_cap ? Part::high_cap : Part::low_cap};
    return roots_ahead(clipped_roots(interior, slab, true), Side::inner);
}

template <class Real>
[[nodiscard]] Roots<Real> own_roots(const QuadricBody<Real>& quadric, const Vec3<Real>& P,
                                    const Vec3<Real>& D, Part part, Side side)
{
    if (part == Part::side)
        return roots_from_side(quadric, P, D, side);
    return side == Side::outer ? Roots<Real>{} : roots_from_cap(quadric, P, D, part);
}

/// Where a ray that leaves the point `P` of a body's `part` on `side` meets the body again, t > 0.
template <class Real>
[[nodiscard]] Roots<Real> own_roots(const PlacedBody<Real>& body, const Vec3<Real>& P,
                                    const Vec3<Real>& D, Part part, Side side)
{
    const Vec3<Real> own_P = body.placement.point_to_own(P);
    const Vec3<Real> own_D = body.placement.vector_to_own(D);
    return std::visit(
        [&](const auto& surface) { return own_roots(surface, own_P, own_D, part, side); },
        body.surface);
}

}  // namespace packtrace::reference
