#pragma once

#include "reference/closest_intersection.hpp"

namespace packtrace::reference {

/// Unit normal at the point `P` of a hit, on the surface's own outer side: away from a
/// sphere's centre, along a plane's normal, up the gradient of a quadric.
template <class Real>
[[nodiscard]] Vec3<Real> outward_normal(const Bodies<Real>& bodies, const Hit<Real>& hit,
                                        const Vec3<Real>& P)
{
    const auto [kind, index] = bodies.places[static_cast<std::size_t>(hit.object)];
    switch (kind) {
        case BodyKind::sphere:
            return normalize(normal_at(bodies.spheres[index], P, hit.part));
        case BodyKind::plane:
            return bodies.planes[index].normal;
        case BodyKind::placed:
            break;
    }
    return normalize(normal_at(bodies.placed[index], P, hit.part));
}

/// The place that a surface's coordinates are off from: a sphere's centre, a plane's point, where
/// a matrix takes the own origin.
template <class Real>
[[nodiscard]] Vec3<Real> place_of(const Bodies<Real>& bodies, int object)
{
    const auto [kind, index] = bodies.places[static_cast<std::size_t>(object)];
    switch (kind) {
        case BodyKind::sphere:
            return bodies.spheres[index].center;
        case BodyKind::plane:
            return bodies.planes[index].point;
        case BodyKind::placed:
            break;
    }
    return bodies.placed[index].placement.point_to_world({});
}

/// The normal's side from which the ray with direction `D` comes.
template <class Real>
[[nodiscard]] Vec3<Real> turned_against(const Vec3<Real>& N, const Vec3<Real>& D)
{
    return dot(N, D) > 0 ? -N : N;
}

/// `P` in the space the object's surface is defined in.
template <class Real>
[[nodiscard]] Vec3<Real> own_point(const Bodies<Real>& bodies, int object, const Vec3<Real>& P)
{
    const auto [kind, index] = bodies.places[static_cast<std::size_t>(object)];
    return kind == BodyKind::placed ? bodies.placed[index].placement.point_to_own(P) : P;
}

}  // namespace packtrace::reference
