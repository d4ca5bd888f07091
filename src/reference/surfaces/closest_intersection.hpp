#pragma once

#include "reference/surfaces/bodies.hpp"

#include <limits>

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

}  // namespace packtrace::reference
