#pragma once

#include "reference/surfaces/hits.hpp"
#include "reference/surfaces/own_roots.hpp"
#include "reference/world.hpp"
#include <packtrace/render.hpp>

namespace packtrace::reference {

/// The t_min of secondary rays by SelfHits::note. Notes 001 and 004 name this number. Note 001
/// counts it in lengths of its directions, which are not normalised; the others in units of length.
template <class Real>
inline constexpr Real epsilon = Real(0.001L);

/// The piece of a surface that a ray leaves, and the side. Both are decided once, when the ray is
/// made.
template <class Real>
struct Departure {
    int object = -1;  ///< -1 for a ray from an eye
    Part part = Part::side;
    Vec3<Real> outward = {};  ///< unit normal
    Side side = Side::outer;

    [[nodiscard]] explicit operator bool() const
    {
        return object >= 0;
    }
    [[nodiscard]] Departure towards(Side other) const
    {
        return {object, part, outward, other};
    }
    /// On the side of direction `D`, as rays to lights leave.
    [[nodiscard]] Departure along(const Vec3<Real>& D) const
    {
        return towards(dot(outward, D) >= 0 ? Side::outer : Side::inner);
    }
};

/// Where a ray starts, and on what. By SelfHits::note it has a point and an epsilon. By
/// SelfHits::exact the body that it starts on is solved with the point known to lie on it; all
/// other bodies are solved from a ray origin offset from the surface.
template <class Real>
struct Start {
    Vec3<Real> on;   ///< the point on the surface
    Vec3<Real> org;  ///< the offset ray origin, for other bodies
    Real t_min = epsilon<Real>;
    int object = -1;  ///< the body that the ray starts on; -1 for none
    Part part = Part::side;
    Side side = Side::outer;  ///< on which the ray leaves it
};

/// The hits of a ray from `start` with one body.
template <class Real, class Body>
[[nodiscard]] Roots<Real> roots_from(const Body& body, const Start<Real>& start,
                                     const Vec3<Real>& D)
{
    return body.object == start.object ? own_roots(body, start.on, D, start.part, start.side)
                                       : roots_of(body, start.org, D);
}

/// The distance from `own`, a hit of the body that the ray starts on, to `other`, a hit of another
/// body close to it, if that body is solved from `start.on` as well, as the own body was.
template <class Real>
[[nodiscard]] Real apart_from(const Bodies<Real>& bodies, const Start<Real>& start,
                              const Vec3<Real>& D, const Hit<Real>& own, const Hit<Real>& other,
                              Real near)
{
    Real apart = other.t - own.t;
    visit_bodies(bodies, [&](const auto& body) {
        if (body.object != other.object)
            return true;
        Real nearest = 4 * near;
        for (const auto& root : roots_of(body, start.on, D))
            if (root.part == other.part && std::abs(root.t - own.t) < nearest) {
                apart = root.t - own.t;
                nearest = std::abs(apart);
            }
        return false;
    });
    return apart;
}

/// Whether `own`, a hit of the body that the ray starts on, comes before `other`, the hit of
/// another body. If both are close, for t or for the place of the start, both are taken from
/// `start.on`. If they then are in one place, the lower object number is hit, however either t was
/// rounded.
template <class Real>
[[nodiscard]] bool own_hit_is_first(const Bodies<Real>& bodies, const Start<Real>& start,
                                    const Vec3<Real>& D, const Hit<Real>& own,
                                    const Hit<Real>& other)
{
    const Real place = size_of(start.on) / std::sqrt(dot(D, D));
    const Real close = Real(0x1p-12) * own.t;
    const Real near = std::min(close + Real(0x1p-42) * place, Real(0.125) * own.t);
    const Real difference = other.t - own.t;
    if (!(std::abs(difference) <= near))
        return difference > 0;
    const Real apart = apart_from(bodies, start, D, own, other, near);
    constexpr Real roundoff = std::numeric_limits<Real>::epsilon();
    if (std::abs(apart) <= 256 * roundoff * own.t + 4 * roundoff * place)
        return own.object < other.object;
    return std::abs(difference) <= close ? apart > 0 : difference > 0;
}

/// The closest hit from `start` on, up to t_max.
template <class Real>
[[nodiscard]] Hit<Real> closest_from(const Bodies<Real>& bodies, const Start<Real>& start,
                                     const Vec3<Real>& D, Real t_max)
{
    if (start.object < 0)
        return closest_intersection(bodies, start.org, D, start.t_min, t_max);
    Hit<Real> own;
    Hit<Real> other;
    visit_bodies(bodies, [&](const auto& body) {
        Hit<Real>& closest = body.object == start.object ? own : other;
        for (const auto& root : roots_from(body, start, D))
            if (root.t >= start.t_min && root.t <= t_max &&
                (root.t < closest.t || (root.t == closest.t && body.object < closest.object)))
                closest = {root.t, body.object, root.part, root.leaving};
        return true;
    });
    if (own.object < 0 || other.object < 0)
        return own.object < 0 ? other : own;
    return own_hit_is_first(bodies, start, D, own, other) ? own : other;
}

/// The point of a hit. The body that the ray starts on was solved from `start.on`.
template <class Real>
[[nodiscard]] Vec3<Real> point_of(const Hit<Real>& hit, const Start<Real>& start,
                                  const Vec3<Real>& D)
{
    return (hit.object == start.object ? start.on : start.org) + hit.t * D;
}

/// The ray origin offset at P on a surface with the outward normal N: a bound of P's distance from
/// the surface, as the kernels have it for double (start_roundoffs in lower/packed_scene.cpp).
template <class Real>
[[nodiscard]] Real origin_offset_at(const Vec3<Real>& place, const Vec3<Real>& P,
                                    const Vec3<Real>& N)
{
    constexpr Real roundoffs = 32 * (std::numeric_limits<Real>::epsilon() / 2);
    const Vec3<Real> off = P - place;
    return roundoffs * (std::abs(N.x) * (std::abs(P.x) + std::abs(off.x)) +
                        std::abs(N.y) * (std::abs(P.y) + std::abs(off.y)) +
                        std::abs(N.z) * (std::abs(P.z) + std::abs(off.z)));
}

/// The start of a ray that leaves a surface at P, or of one from an eye at P.
template <class Real>
[[nodiscard]] Start<Real> start_at(const World<Real>& world, const Departure<Real>& left,
                                   const Vec3<Real>& P)
{
    if (!left || world.self_hits == SelfHits::note)
        return {P, P};
    const Real offset = origin_offset_at(place_of(world.bodies, left.object), P, left.outward);
    return {P,
            P + (left.side == Side::outer ? offset : -offset) * left.outward,
            std::numeric_limits<Real>::min(),
            left.object,
            left.part,
            left.side};
}

}  // namespace packtrace::reference
