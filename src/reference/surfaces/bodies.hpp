#pragma once

#include "reference/surfaces/affine.hpp"
#include "reference/surfaces/plane.hpp"
#include "reference/surfaces/polygon.hpp"
#include "reference/surfaces/quadric.hpp"
#include "reference/surfaces/sphere.hpp"
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <functional>
#include <variant>
#include <vector>

namespace packtrace::reference {

/// A surface under a matrix, like all objects of note 004: rays are taken to its own space.
template <class Real>
struct PlacedBody {
    Affine<Real> placement;
    std::variant<SphereBody<Real>, PlaneBody<Real>, QuadricBody<Real>, PolygonBody<Real>> surface;
    int object = 0;
};

enum class BodyKind { sphere, plane, polygon, placed };

/// A scene's surfaces, converted once. Objects without a matrix stay in world space. Polygons are
/// always taken to world space, so that neighbours share their corners exactly.
template <class Real>
struct Bodies {
    struct Place {
        BodyKind kind;
        std::size_t index;
    };
    std::vector<SphereBody<Real>> spheres;
    std::vector<PlaneBody<Real>> planes;
    std::vector<PolygonBody<Real>> polygons;
    std::vector<PlacedBody<Real>> placed;
    std::vector<Place> places;  ///< by object number, if all objects are taken

    /// Takes all objects, or those for which `wanted` is true. By SelfHits::note spheres are solved
    /// by the note's own formula, by SelfHits::exact by one without cancellation.
    explicit Bodies(const Scene& scene, SelfHits rule = default_self_hits,
                    const std::function<bool(const Object&)>& wanted = {});
};

/// Object number `object` of a scene in its own space, whether it has a matrix or not.
template <class Real>
[[nodiscard]] PlacedBody<Real> place_body(const Object& from, int object, SelfHits rule);

/// Calls `visit` with one body after the other until it returns false.
template <class Real, class Visit>
void visit_bodies(const Bodies<Real>& bodies, const Visit& visit)
{
    for (const SphereBody<Real>& sphere : bodies.spheres)
        if (!visit(sphere))
            return;
    for (const PlaneBody<Real>& plane : bodies.planes)
        if (!visit(plane))
            return;
    for (const PolygonBody<Real>& polygon : bodies.polygons)
        if (!visit(polygon))
            return;
    for (const PlacedBody<Real>& body : bodies.placed)
        if (!visit(body))
            return;
}

template <class Real>
[[nodiscard]] Roots<Real> roots_of(const PlacedBody<Real>& body, const Vec3<Real>& org,
                                   const Vec3<Real>& dir)
{
    const Vec3<Real> own_org = body.placement.point_to_own(org);
    const Vec3<Real> own_dir = body.placement.vector_to_own(dir);
    return std::visit([&](const auto& surface) { return roots_of(surface, own_org, own_dir); },
                      body.surface);
}

template <class Real>
[[nodiscard]] Vec3<Real> normal_at(const PlacedBody<Real>& body, const Vec3<Real>& P, Part part)
{
    const Vec3<Real> own = body.placement.point_to_own(P);
    return body.placement.normal_to_world(std::visit(
        [&](const auto& surface) { return normal_at(surface, own, part); }, body.surface));
}

/// Where its matrix takes the origin of own space.
template <class Real>
[[nodiscard]] Vec3<Real> place_of(const PlacedBody<Real>& body)
{
    return body.placement.point_to_world({});
}

template <class Real>
[[nodiscard]] Real value_at(const PlacedBody<Real>& body, const Vec3<Real>& P, Part part)
{
    const Vec3<Real> own = body.placement.point_to_own(P);
    return std::visit([&](const auto& surface) { return value_at(surface, own, part); },
                      body.surface);
}

}  // namespace packtrace::reference
