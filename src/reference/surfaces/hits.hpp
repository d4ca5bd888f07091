#pragma once

#include "reference/surfaces/bodies.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

// Hits of rays: the closest hit, its normal, and all hits.
namespace packtrace::reference {

template <class Real>
struct Hit {
    Real t = std::numeric_limits<Real>::infinity();
    int object = -1;  ///< -1 for none
    Part part = Part::side;
    bool leaving = false;  ///< the ray comes from the inside

    [[nodiscard]] explicit operator bool() const
    {
        return object >= 0;
    }
};

/// The nearest root in the closed range [t_min, t_max], over all objects one by one; among
/// equal t the lower object number.
template <class Real>
[[nodiscard]] Hit<Real> closest_intersection(const Bodies<Real>& bodies, const Vec3<Real>& O,
                                             const Vec3<Real>& D, Real t_min, Real t_max)
{
    Hit<Real> closest;
    const auto offer = [&](Real t, int object, Part part, bool leaving) {
        if (t >= t_min && t <= t_max &&
            (t < closest.t || (t == closest.t && object < closest.object)))
            closest = {t, object, part, leaving};
    };
    for (const SphereBody<Real>& sphere : bodies.spheres) {
        const Interior<Real> interior = interior_along(sphere, O, D);
        offer(interior.first, sphere.object, Part::side, false);
        offer(interior.last, sphere.object, Part::side, true);
    }
    for (const PlaneBody<Real>& plane : bodies.planes)
        offer(intersect_ray_plane(O, D, plane), plane.object, Part::side, dot(plane.normal, D) > 0);
    for (const PolygonBody<Real>& polygon : bodies.polygons)
        for (const auto& root : roots_of(polygon, O, D))
            offer(root.t, polygon.object, root.part, root.leaving);
    for (const PlacedBody<Real>& body : bodies.placed)
        for (const auto& root : roots_of(body, O, D))
            offer(root.t, body.object, root.part, root.leaving);
    return closest;
}

/// The normal at a hit, and the side of the surface from which the ray comes.
template <class Real>
struct Facing {
    Vec3<Real> outward;  ///< unit: away from a sphere's centre, along a plane's normal, up the
                         ///< gradient of a quadric
    bool leaving;        ///< the ray comes from the inside

    /// The normal turned against the ray.
    [[nodiscard]] Vec3<Real> turned() const
    {
        return leaving ? -outward : outward;
    }
};

/// Calls `visit` with the body of an object.
template <class Real, class Visit>
auto with_body(const Bodies<Real>& bodies, int object, const Visit& visit)
{
    const auto [kind, index] = bodies.places[static_cast<std::size_t>(object)];
    switch (kind) {
        case BodyKind::sphere:
            return visit(bodies.spheres[index]);
        case BodyKind::plane:
            return visit(bodies.planes[index]);
        case BodyKind::polygon:
            return visit(bodies.polygons[index]);
        case BodyKind::placed:
            break;
    }
    return visit(bodies.placed[index]);
}

/// Outwards, not normalised, at the point `P` of a hit.
template <class Real>
[[nodiscard]] Vec3<Real> gradient_at(const Bodies<Real>& bodies, const Hit<Real>& hit,
                                     const Vec3<Real>& P)
{
    return with_body(bodies, hit.object,
                     [&](const auto& body) { return normal_at(body, P, hit.part); });
}

/// The point `P` of a hit, moved onto the surface. After a long `way`, rounding puts P so far off
/// that objects in one place could not be recognised as such. P moves by rounding errors at most,
/// so that a vanishing gradient at an apex cannot throw it far away.
template <class Real>
[[nodiscard]] Vec3<Real> on_surface(const Bodies<Real>& bodies, const Hit<Real>& hit,
                                    const Vec3<Real>& P, Real way)
{
    constexpr Real roundoffs = 64 * std::numeric_limits<Real>::epsilon();
    const Vec3<Real> gradient = gradient_at(bodies, hit, P);
    const Real value = with_body(bodies, hit.object,
                                 [&](const auto& body) { return value_at(body, P, hit.part); });
    const bool by_rounding = std::abs(value) <= roundoffs * way * length(gradient);
    return by_rounding && value != 0 ? P - (value / dot(gradient, gradient)) * gradient : P;
}

/// The facing at the point `P` of a hit of a ray along `D`. Where the gradient vanishes, at a
/// cone's apex or the edge of crossing planes, the normal is the unit vector against the ray.
template <class Real>
[[nodiscard]] Facing<Real> facing(const Bodies<Real>& bodies, const Hit<Real>& hit,
                                  const Vec3<Real>& P, const Vec3<Real>& D)
{
    if (const auto outward = unit(gradient_at(bodies, hit, P)))
        return {*outward, hit.leaving};
    return {-unit(D).value_or(Vec3<Real>()), false};
}

/// The position that an object's surface is defined relative to.
template <class Real>
[[nodiscard]] Vec3<Real> place_of(const Bodies<Real>& bodies, int object)
{
    return with_body(bodies, object, [](const auto& body) { return place_of(body); });
}

/// `P` in the space the object's surface is defined in.
template <class Real>
[[nodiscard]] Vec3<Real> own_point(const Bodies<Real>& bodies, int object, const Vec3<Real>& P)
{
    const auto [kind, index] = bodies.places[static_cast<std::size_t>(object)];
    return kind == BodyKind::placed ? bodies.placed[index].placement.point_to_own(P) : P;
}

/// One hit of a ray.
template <class Real>
struct SurfaceHit {
    Real t;
    int object;
    Vec3<Real> normal;  ///< unit, outward, not turned against the ray
    bool leaving;       ///< the ray comes from the inside
};

/// All hits with t in [t_min, t_max], by increasing t, then object number. A ray that touches a
/// surface hits it twice at the same t.
template <class Real>
[[nodiscard]] std::vector<SurfaceHit<Real>> all_hits(const Bodies<Real>& bodies,
                                                     const Vec3<Real>& org, const Vec3<Real>& dir,
                                                     Real t_min, Real t_max)
{
    std::vector<SurfaceHit<Real>> hits;
    visit_bodies(bodies, [&](const auto& body) {
        for (const auto& root : roots_of(body, org, dir)) {
            if (root.t < t_min || root.t > t_max)
                continue;
            const Hit<Real> hit{root.t, body.object, root.part, root.leaving};
            const Facing<Real> at = facing(bodies, hit, org + root.t * dir, dir);
            hits.push_back({root.t, body.object, at.outward, root.leaving});
        }
        return true;
    });
    std::stable_sort(hits.begin(), hits.end(), [](const auto& a, const auto& b) {
        return std::pair(a.t, a.object) < std::pair(b.t, b.object);
    });
    return hits;
}

}  // namespace packtrace::reference
