#pragma once

#include <packtrace/render.hpp>
#include "reference/epsilon.hpp"
#include "reference/surface_normal.hpp"
#include "reference/world.hpp"

namespace packtrace::reference {

/// Where a ray begins, and what it begins on. By SelfHits::note that is its point alone and an
/// epsilon; by SelfHits::exact its own surface is solved as one that the point is on, and all
/// others from a little off it.
template <class Real>
struct Start {
    Vec3<Real> on;   ///< the point itself
    Vec3<Real> org;  ///< from where other surfaces are looked for
    Real t_min = epsilon<Real>;
    int object = -1;  ///< own surface; -1 for none
    Part part = Part::side;
    bool outside = false;  ///< the ray leaves on its surface's outer side

    [[nodiscard]] bool is_own(int hit_object, Part hit_part) const
    {
        return hit_object == object && hit_part == part;
    }
};

/// The meeting at t != 0 of a ray with a quadratic surface that it starts on, a t² + 2 b t = 0;
/// infinite for none. b has the sign of the side that the ray leaves on, whatever rounding says.
template <class Real>
[[nodiscard]] Real other_root(Real a, Real b, bool outside)
{
    const Real t = (outside ? -2 : 2) * std::abs(b) / a;
    return t > 0 ? t : infinity<Real>;
}

template <class Real>
[[nodiscard]] Real second_root(const SphereBody<Real>& sphere, const Vec3<Real>& P,
                               const Vec3<Real>& D, const Start<Real>& start)
{
    return other_root(dot(D, D), dot(P - sphere.center, D), start.outside);
}

template <class Real>
[[nodiscard]] Real second_root(const PlaneBody<Real>&, const Vec3<Real>&, const Vec3<Real>&,
                               const Start<Real>&)
{
    return infinity<Real>;
}

template <class Real>
[[nodiscard]] Real second_root(const QuadricBody<Real>& quadric, const Vec3<Real>& P,
                               const Vec3<Real>& D, const Start<Real>& start)
{
    if (start.part != Part::side)
        return infinity<Real>;
    const Real t = other_root(quadric.quadratic(D), dot(quadric.gradient(P), D) / 2, start.outside);
    const Real z = P.z + t * D.z;
    return quadric.low <= z && z <= quadric.high ? t : infinity<Real>;
}

template <class Real>
[[nodiscard]] Real second_root(const PlacedBody<Real>& body, const Vec3<Real>& P,
                               const Vec3<Real>& D, const Start<Real>& start)
{
    const Vec3<Real> own_P = body.placement.point_to_own(P);
    const Vec3<Real> own_D = body.placement.vector_to_own(D);
    return std::visit(
        [&](const auto& surface) { return second_root(surface, own_P, own_D, start); },
        body.surface);
}

/// Where a ray that begins at `start` meets a body.
template <class Real, class Body>
[[nodiscard]] Roots<Real> roots_from(const Body& body, const Start<Real>& start,
                                     const Vec3<Real>& D)
{
    const Roots<Real> roots = roots_of(body, start.org, D);
    if (body.object != start.object)
        return roots;
    Roots<Real> result;
    for (const auto& root : roots)
        if (root.part != start.part)
            result.add(root.t, root.part);
    result.add(second_root(body, start.on, D, start), start.part);
    return result;
}

/// The nearest meeting from `start` on, as closest_intersection has it.
template <class Real>
[[nodiscard]] Hit<Real> closest_from(const Bodies<Real>& bodies, const Start<Real>& start,
                                     const Vec3<Real>& D, Real t_max)
{
    if (start.object < 0)
        return closest_intersection(bodies, start.org, D, start.t_min, t_max);
    Hit<Real> closest;
    visit_bodies(bodies, [&](const auto& body) {
        for (const auto& root : roots_from(body, start, D))
            if (root.t >= start.t_min && root.t <= t_max &&
                (root.t < closest.t || (root.t == closest.t && body.object < closest.object)))
                closest = {root.t, body.object, root.part};
        return true;
    });
    return closest;
}

/// The point of a hit: the own surface was solved from the start itself.
template <class Real>
[[nodiscard]] Vec3<Real> point_of(const Hit<Real>& hit, const Start<Real>& start,
                                  const Vec3<Real>& D)
{
    return (start.is_own(hit.object, hit.part) ? start.on : start.org) + hit.t * D;
}

/// How far off a surface at P with the outward normal N rounding can be, as the packets have it.
template <class Real>
[[nodiscard]] Real lift_at(const Vec3<Real>& place, const Vec3<Real>& P, const Vec3<Real>& N)
{
    constexpr Real roundoffs = 32 * (std::numeric_limits<Real>::epsilon() / 2);
    const Vec3<Real> off = P - place;
    return roundoffs * (std::abs(N.x) * (std::abs(P.x) + std::abs(off.x)) +
                        std::abs(N.y) * (std::abs(P.y) + std::abs(off.y)) +
                        std::abs(N.z) * (std::abs(P.z) + std::abs(off.z)));
}

/// Where a ray begins that leaves the surface of `hit` at P in the direction D, or with no hit
/// one from an eye at P.
template <class Real>
[[nodiscard]] Start<Real> start_at(const World<Real>& world, const Hit<Real>& hit,
                                   const Vec3<Real>& P, const Vec3<Real>& D)
{
    if (!hit || world.self_hits == SelfHits::note)
        return {P, P};
    const Vec3<Real> N = outward_normal(world.bodies, hit, P);
    const bool outside = dot(N, D) >= 0;
    const Real lift = lift_at(place_of(world.bodies, hit.object), P, N);
    return {P,
            P + (outside ? lift : -lift) * N,
            std::numeric_limits<Real>::min(),
            hit.object,
            hit.part,
            outside};
}

}  // namespace packtrace::reference
