#include "lower/check_scene.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include <glm/matrix.hpp>
#include <packtrace/read_scene.hpp>

#include "geometry/kinds.hpp"
#include "lower/in_parallel.hpp"

namespace packtrace {
namespace {

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
        if (const Fault reason = why_no_surface(*quadric))
            throw SceneError(name_of(scene, number) + ": " + *reason);
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

void check_min_weight(const Scene& scene)
{
    if (!(scene.min_weight >= 0.0 && scene.min_weight <= 1.0))
        throw std::invalid_argument("min_weight is " + std::to_string(scene.min_weight) +
                                    "; use a number from 0 to 1");
}

void check_scene(const Scene& scene)
{
    check_lights(scene);
    check_min_weight(scene);
    const Object* const first = scene.objects.data();
    for_each_in_parallel(scene.objects, [&](const Object& object) {
        check_object(scene, static_cast<std::size_t>(&object - first));
    });
}

}  // namespace packtrace
