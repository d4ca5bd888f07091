#pragma once

#include "reference/surfaces/closest_intersection.hpp"

namespace packtrace::reference {

/// How a surface stands to the ray that meets it.
template <class Real>
struct Facing {
    Vec3<Real> outward;  ///< unit, on the surface's own outer side: away from a sphere's centre,
                         ///< along a plane's normal, up the gradient of a quadric
    bool leaving;        ///< the ray comes from the inside

    /// The normal's side from which the ray comes.
    [[nodiscard]] Vec3<Real> turned() const
    {
        return leaving ? -outward : outward;
    }
};

/// Outwards, not normalised, at the point `P` of a hit.
template <class Real>
[[nodiscard]] Vec3<Real> gradient_at(const Bodies<Real>& bodies, const Hit<Real>& hit,
                                     const Vec3<Real>& P)
{
    const auto [kind, index] = bodies.places[static_cast<std::size_t>(hit.object)];
    switch (kind) {
        case BodyKind::sphere:
            return normal_at(bodies.spheres[index], P, hit.part);
        case BodyKind::plane:
            return normal_at(bodies.planes[index], P, hit.part);
        case BodyKind::polygon:
            return normal_at(bodies.polygons[index], P, hit.part);
        case BodyKind::placed:
            break;
    }
    return normal_at(bodies.placed[index], P, hit.part);
}

/// At the point `P` of a hit of a ray along `D`. Where the gradient vanishes, at a cone's apex or
/// the edge of crossing planes, the normal is the unit vector against the ray.
template <class Real>
[[nodiscard]] Facing<Real> facing(const Bodies<Real>& bodies, const Hit<Real>& hit,
                                  const Vec3<Real>& P, const Vec3<Real>& D)
{
    if (const auto outward = unit(gradient_at(bodies, hit, P)))
        return {*outward, hit.leaving};
    return {-unit(D).value_or(Vec3<Real>()), false};
}

/// The place that a surface's coordinates are off from: a sphere's centre, a plane's or a
/// polygon's first point, where
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
        case BodyKind::polygon:
            return bodies.polygons[index].contours[0][0];
        case BodyKind::placed:
            break;
    }
    return bodies.placed[index].placement.point_to_world({});
}

/// `P` in the space the object's surface is defined in.
template <class Real>
[[nodiscard]] Vec3<Real> own_point(const Bodies<Real>& bodies, int object, const Vec3<Real>& P)
{
    const auto [kind, index] = bodies.places[static_cast<std::size_t>(object)];
    return kind == BodyKind::placed ? bodies.placed[index].placement.point_to_own(P) : P;
}

}  // namespace packtrace::reference
