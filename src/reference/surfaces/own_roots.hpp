#pragma once

#include "reference/surfaces/bodies.hpp"

#include <limits>

// Where a ray that starts on a surface hits that surface again. It is known that the start is on
// the surface, and on which side the ray leaves. So one of the side's two roots is 0, however the
// constant term is rounded; the start is between the clipping planes; and a start on a cap is
// inside the side.
namespace packtrace::reference {

/// The side of a surface on which a ray leaves it.
enum class Side { outer, inner };

/// The interior along a ray that starts on the side itself: a t² + 2 b t = 0, where `side` decides
/// the sign of b.
template <class Real>
[[nodiscard]] Interior<Real> interior_from_side(const QuadricLine<Real>& line, Side side)
{
    constexpr Real infinite = std::numeric_limits<Real>::infinity();
    const Real b = side == Side::outer ? std::abs(line.b) : -std::abs(line.b);
    if (line.parallel)
        return side == Side::outer ? Interior<Real>{-infinite, 0, true}
                                   : Interior<Real>{0, infinite, true};
    // From a cone's apex into one of its halves, which holds the whole ray.
    if (b == 0 && line.a < 0)
        return {};
    const Real other = -2 * b / line.a;
    return {std::min(Real(0), other), std::max(Real(0), other), line.a > 0};
}

/// `interior` changed so that t = 0 is inside it or on its edge.
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

/// The roots ahead of a start at t = 0. A root that rounding put at the start gets the smallest
/// positive t.
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
        ahead.add({std::max(roots.root[next].t, std::numeric_limits<Real>::min()),
                   roots.root[next].part, roots.root[next].leaving});
    return ahead;
}

template <class Real>
[[nodiscard]] Roots<Real> own_roots(const SphereBody<Real>& sphere, const Vec3<Real>& P,
                                    const Vec3<Real>& D, Part, Side side)
{
    const QuadricLine<Real> line{.a = dot(D, D), .b = dot(P - sphere.center, D), .parallel = false};
    return roots_ahead(clipped_roots(interior_from_side(line, side), Slab<Real>()), side);
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
    const QuadricLine<Real> line =
        line_of(quadric, quadric.point_to_canonical(P), quadric.vector_to_canonical(D));
    Slab<Real> slab = slab_of(quadric, P.z, D.z);
    slab.enter = std::min(slab.enter, Real(0));
    slab.leave = std::max(slab.leave, Real(0));
    if (D.z == 0)
        slab = {};
    return roots_ahead(clipped_roots(interior_from_side(line, side), slab), side);
}

/// From a point on a cap into the body. A ray that leaves the body has no roots ahead.
template <class Real>
[[nodiscard]] Roots<Real> roots_from_cap(const QuadricBody<Real>& quadric, const Vec3<Real>& P,
                                         const Vec3<Real>& D, Part cap)
{
    const Interior<Real> interior = around_start(
        interior_along(quadric, quadric.point_to_canonical(P), quadric.vector_to_canonical(D)));
    const Real across = (quadric.high - quadric.low) / std::abs(D.z);
    const Slab<Real> slab{.enter = 0,
                          .leave = across,
                          .enters_by = cap,
                          .leaves_by = cap == Part::low_cap ? Part::high_cap : Part::low_cap,
                          .capped = true};
    return roots_ahead(clipped_roots(interior, slab), Side::inner);
}

template <class Real>
[[nodiscard]] Roots<Real> own_roots(const QuadricBody<Real>& quadric, const Vec3<Real>& P,
                                    const Vec3<Real>& D, Part part, Side side)
{
    if (part == Part::side)
        return roots_from_side(quadric, P, D, side);
    return side == Side::outer ? Roots<Real>{} : roots_from_cap(quadric, P, D, part);
}

/// The hits of a ray with the body that it starts on, at the point `P` of its `part`, where it
/// leaves on `side`; t > 0.
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
