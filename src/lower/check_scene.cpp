#include "lower/check_scene.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include <glm/matrix.hpp>
#include <packtrace/read_scene.hpp>

#include "lower/canonical_form.hpp"
#include "lower/in_parallel.hpp"
#include "scene/quadric_kinds.hpp"

namespace packtrace {
namespace {

bool is_finite(const Vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Reads well with an object's name or number before it.
using Fault = std::optional<std::string>;

Fault fault_of(const Sphere& sphere)
{
    if (!is_finite(sphere.center))
        return "the sphere's center is not finite; give it three finite numbers";
    if (!(sphere.radius > 0.0) || std::isinf(sphere.radius))
        return "the sphere's radius is " + std::to_string(sphere.radius) +
               "; use a finite one above 0";
    return std::nullopt;
}

Fault fault_of(const Plane& plane)
{
    if (!is_finite(plane.point))
        return "the plane's point is not finite; give it three finite numbers";
    if (!is_finite(plane.normal) || plane.normal == Vec3(0.0))
        return "the plane's normal points nowhere; give it a finite one other than (0, 0, 0)";
    return std::nullopt;
}

Fault fault_of(const Quadric& quadric)
{
    const QuadricKindInfo* const kind = find_quadric_kind(quadric.kind);
    if (kind != nullptr && quadric.coefficients != kind->coefficients)
        return "the coefficients are not those of its kind, " + std::string(kind->name) +
               "; fill them in, or make the kind general";
    for (const double coefficient : quadric.coefficients)
        if (!std::isfinite(coefficient))
            return "a coefficient of the quadric is not finite; use finite ones";
    const auto& range = quadric.z_range;
    if (range &&
        !(std::isfinite(range->low) && std::isfinite(range->high) && range->low < range->high))
        return "the z_range is empty or not finite; give it a low end and a higher one";
    if (quadric.capped && !range)
        return "capped closes the ends of a z_range, and there is none; add one";
    return std::nullopt;
}

Fault fault_of(const Mat4& transform)
{
    for (int column = 0; column < 4; ++column)
        if (!is_finite(Vec3(transform[column])))
            return "the transform is not finite; use finite numbers";
    if (!std::isnormal(glm::determinant(Mat3(transform))))
        return "the transform flattens the object; use factors other than 0 and near to 1";
    return std::nullopt;
}

/// std::variant's alternatives have the order of the enumeration.
bool is_of_model(const Material& material, Illumination illumination)
{
    return material.model.index() == static_cast<std::size_t>(illumination);
}

std::string name_of(const Scene& scene, std::size_t number)
{
    const std::string& name = scene.objects[number].name;
    return name.empty() ? "object number " + std::to_string(number) : "object '" + name + "'";
}

void check_surface_exists(const Scene& scene, std::size_t number, const Quadric& quadric)
{
    if (quadric.kind != QuadricKind::general)
        return;
    if (const auto reason = why_no_surface(canonical_form(quadric.coefficients)))
        throw SceneError(name_of(scene, number) + ": the quadric has no surface: " + *reason +
                         "; change its coefficients");
}

}  // namespace

void check_object(const Scene& scene, std::size_t number)
{
    const Object& object = scene.objects[number];
    Fault fault = std::visit([](const auto& surface) { return fault_of(surface); }, object.surface);
    if (!fault)
        fault = fault_of(object.transform);
    if (!fault && !is_of_model(object.material, scene.illumination))
        fault = "the material is of another illumination model; give it the scene's";
    if (fault)
        throw std::invalid_argument(name_of(scene, number) + ": " + *fault);
    if (const auto* quadric = std::get_if<Quadric>(&object.surface))
        check_surface_exists(scene, number, *quadric);
}

void check_lights(const Scene& scene)
{
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        const bool nowhere = light.type == LightType::directional && light.vector == Vec3(0.0);
        if (light.type != LightType::ambient && (nowhere || !is_finite(light.vector)))
            throw std::invalid_argument("light number " + std::to_string(i) +
                                        ": its position or direction is not finite or points "
                                        "nowhere; give it three finite numbers, not all 0");
    }
}

void check_scene(const Scene& scene)
{
    check_lights(scene);
    const Object* const first = scene.objects.data();
    for_each_in_parallel(scene.objects, [&](const Object& object) {
        check_object(scene, static_cast<std::size_t>(&object - first));
    });
}

}  // namespace packtrace
