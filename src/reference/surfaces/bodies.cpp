#include "reference/surfaces/bodies.hpp"

namespace packtrace::reference {
namespace {

template <class Real>
SphereBody<Real> convert_surface(const Sphere& sphere, int object, SelfHits rule)
{
    return {Vec3<Real>(sphere.center), static_cast<Real>(sphere.radius), object,
            rule == SelfHits::note};
}

template <class Real>
PlaneBody<Real> convert_surface(const Plane& plane, int object, SelfHits)
{
    return {Vec3<Real>(plane.point), normalize(Vec3<Real>(plane.normal)), object};
}

template <class Real>
QuadricBody<Real> convert_surface(const Quadric& quadric, int object, SelfHits)
{
    QuadricBody<Real> body{.form = canonical_quadric<Real>(quadric.coefficients)};
    if (quadric.z_range) {
        body.low = static_cast<Real>(quadric.z_range->low);
        body.high = static_cast<Real>(quadric.z_range->high);
    }
    body.capped = quadric.capped && quadric.z_range;
    body.object = object;
    return body;
}

template <class Real>
PolygonBody<Real> convert_surface(const Polygon& polygon, int object, SelfHits)
{
    return polygon_body<Real>(polygon, Mat4(1.0), object);
}

}  // namespace

template <class Real>
PlacedBody<Real> place_body(const Object& from, int object, SelfHits rule)
{
    return std::visit(
        [&](const auto& surface) {
            return PlacedBody<Real>{Affine<Real>(from.transform),
                                    convert_surface<Real>(surface, object, rule), object};
        },
        from.surface);
}

template PlacedBody<float> place_body(const Object&, int, SelfHits);
template PlacedBody<double> place_body(const Object&, int, SelfHits);
template PlacedBody<long double> place_body(const Object&, int, SelfHits);

template <class Real>
Bodies<Real>::Bodies(const Scene& scene, SelfHits rule,
                     const std::function<bool(const Object&)>& wanted)
{
    int number = 0;
    for (const Object& from : scene.objects) {
        const int object = number++;
        if (wanted && !wanted(from))
            continue;
        const bool in_world = from.transform == Mat4(1.0);
        if (const auto* sphere = std::get_if<Sphere>(&from.surface); sphere && in_world) {
            places.push_back({BodyKind::sphere, spheres.size()});
            spheres.push_back(convert_surface<Real>(*sphere, object, rule));
        } else if (const auto* plane = std::get_if<Plane>(&from.surface); plane && in_world) {
            places.push_back({BodyKind::plane, planes.size()});
            planes.push_back(convert_surface<Real>(*plane, object, rule));
        } else if (const auto* polygon = std::get_if<Polygon>(&from.surface)) {
            places.push_back({BodyKind::polygon, polygons.size()});
            polygons.push_back(polygon_body<Real>(*polygon, from.transform, object));
        } else {
            places.push_back({BodyKind::placed, placed.size()});
            placed.push_back(place_body<Real>(from, object, rule));
        }
    }
}

template struct Bodies<float>;
template struct Bodies<double>;
template struct Bodies<long double>;

}  // namespace packtrace::reference
