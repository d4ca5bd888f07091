#include "lower/lower_material.hpp"

#include <variant>

#include <glm/matrix.hpp>

namespace packtrace {
namespace {

/// Note 001: the colour tints all of the local light, the highlight too; the mirror is white
/// and takes its share from the local light.
LoweredMaterial lower_model(const ScratchMaterial& material, const Rgb& color,
                            const LightSums& lights)
{
    LoweredMaterial lowered;
    lowered.ambient = color * lights.ambient;
    lowered.diffuse = color;
    if (material.specular != -1.0) {
        lowered.highlight = color;
        lowered.shininess = material.specular;
    }
    if (material.reflective > 0.0) {
        lowered.reflect = Rgb(material.reflective);
        lowered.local = Rgb(1.0 - material.reflective);
    }
    return lowered;
}

/// Note 000: Ks is mirror and highlight, Kr the transmitted share, both white.
LoweredMaterial lower_model(const SketchMaterial& material, const Rgb& color,
                            const LightSums& lights)
{
    LoweredMaterial lowered;
    lowered.ambient = material.ambient * color * lights.ambient;
    lowered.diffuse = material.diffuse * color;
    lowered.highlight = material.specular;
    lowered.reflect = material.specular;
    lowered.transmit = material.refractive;
    lowered.shininess = material.shininess;
    lowered.ior = material.ior;
    return lowered;
}

/// Note 002, as note 000 with other names.
LoweredMaterial lower_model(const WhittedMaterial& material, const Rgb& color,
                            const LightSums& lights)
{
    const SketchMaterial same{material.ambient,      material.diffuse,   material.specular,
                              material.transmissive, material.shininess, material.ior};
    return lower_model(same, color, lights);
}

/// Note 004: r0 counts once for each light, whatever is in its way.
LoweredMaterial lower_model(const ShaderMaterial& material, const Rgb& color,
                            const LightSums& lights)
{
    LoweredMaterial lowered;
    lowered.ambient = material.reflectance[0] * color * lights.all;
    lowered.diffuse = material.reflectance[1] * color;
    lowered.highlight = material.reflectance[2] * color;
    lowered.shininess = material.reflectance[3];
    return lowered;
}

LoweredMaterial lower_model(const GeneralMaterial& material, const Rgb&, const LightSums& lights)
{
    LoweredMaterial lowered;
    lowered.ambient = material.ambient * lights.ambient;
    lowered.diffuse = material.diffuse;
    lowered.highlight = material.highlight;
    lowered.reflect = material.reflect;
    lowered.transmit = material.transmit;
    lowered.shininess = material.shininess;
    lowered.ior = material.ior;
    return lowered;
}

LoweredMaterial lower_color(const Object& object, const Rgb& color, const LightSums& lights)
{
    return std::visit([&](const auto& model) { return lower_model(model, color, lights); },
                      object.material.model);
}

/// u·P - u·point of the plane's own space, as a function of the world's P.
LoweredChecker lower_checker(const Plane& plane, const Mat4& transform, double size)
{
    const Mat3 inverse = glm::inverse(Mat3(transform));
    LoweredChecker checker;
    checker.point = Vec3(transform * glm::dvec4(plane.point, 1.0));
    checker.u = (plane.u / size) * inverse;
    checker.v = (plane.v / size) * inverse;
    return checker;
}

}  // namespace

LightSums sum_lights(const Scene& scene)
{
    LightSums sums;
    for (const Light& light : scene.lights) {
        sums.all += light.intensity;
        if (light.type == LightType::ambient)
            sums.ambient += light.intensity;
    }
    return sums;
}

abi::MaterialIndex lower_material(const Object& object, std::int32_t number,
                                  const LightSums& lights, RecentMaterials& recent,
                                  LoweredScene& lowered)
{
    const Material& material = object.material;
    const LoweredMaterial first = lower_color(object, material.color, lights);
    const auto* plane = std::get_if<Plane>(&object.surface);
    if (!material.checker || plane == nullptr)
        return {recent.place_of(first, lowered.materials), -1, number};

    const abi::MaterialIndex index{static_cast<std::int32_t>(lowered.materials.size()),
                                   static_cast<std::int32_t>(lowered.checkers.size()), number};
    lowered.checkers.push_back(lower_checker(*plane, object.transform, material.checker->size));
    lowered.materials.push_back(first);
    lowered.materials.push_back(lower_color(object, material.checker->other, lights));
    return index;
}

}  // namespace packtrace
