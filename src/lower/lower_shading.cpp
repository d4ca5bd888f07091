#include "lower/lower_shading.hpp"

#include "core/cut_rays.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cstring>
#include <variant>

namespace packtrace {
namespace {

/// The t_min that notes 001 and 004 give rays.
constexpr double note_epsilon = 0.001;

/// Note 001 shows only what lies behind the viewport, where camera rays have t = 1.
constexpr double scratch_camera_t_min = 1.0;

constexpr std::size_t words = sizeof(LoweredMaterial) / sizeof(std::uint64_t);
static_assert(sizeof(LoweredMaterial) == 20 * sizeof(double), "no byte between the values");

std::uint64_t hash_of(const LoweredMaterial& material)
{
    std::uint64_t word[words];
    std::memcpy(word, &material, sizeof material);
    std::uint64_t hash = 0;
    for (const std::uint64_t value : word)
        hash = (hash ^ value) * 0x9E3779B97F4A7C15u + (hash >> 32u);
    return hash >> 32u;
}

/// Whether both have the same bits: -0 and 0 shade alike, but are two materials.
bool same(const LoweredMaterial& a, const LoweredMaterial& b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Note 001: the colour multiplies all of the local light, highlights included. The mirror is
/// white, and its share is taken from the local light.
LoweredMaterial lower_model(const ScratchMaterial& material, const Rgb& color,
                            const LightSums& lights)
{
    LoweredMaterial lowered{.ambient = color * lights.ambient, .diffuse = color};
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

/// Note 000: Ks is the mirror and the highlight, Kr the transmitted share; both are white.
LoweredMaterial lower_model(const SketchMaterial& material, const Rgb& color,
                            const LightSums& lights)
{
    return {.ambient = material.ambient * color * lights.ambient,
            .diffuse = material.diffuse * color,
            .highlight = material.specular,
            .reflect = material.specular,
            .transmit = material.refractive,
            .shininess = material.shininess,
            .ior = material.ior};
}

/// Note 002: as note 000, with other names.
LoweredMaterial lower_model(const WhittedMaterial& material, const Rgb& color,
                            const LightSums& lights)
{
    const SketchMaterial same{material.ambient,      material.diffuse,   material.specular,
                              material.transmissive, material.shininess, material.ior};
    return lower_model(same, color, lights);
}

/// Note 004: r0 counts once for each light, occluded or not.
LoweredMaterial lower_model(const ShaderMaterial& material, const Rgb& color,
                            const LightSums& lights)
{
    return {.ambient = material.reflectance[0] * color * lights.all,
            .diffuse = material.reflectance[1] * color,
            .highlight = material.reflectance[2] * color,
            .shininess = material.reflectance[3]};
}

LoweredMaterial lower_model(const GeneralMaterial& material, const Rgb&, const LightSums& lights)
{
    return {.ambient = material.ambient * lights.ambient,
            .diffuse = material.diffuse,
            .highlight = material.highlight,
            .reflect = material.reflect,
            .transmit = material.transmit,
            .shininess = material.shininess,
            .ior = material.ior};
}

LoweredMaterial lower_color(const Object& object, const Rgb& color, const LightSums& lights)
{
    return std::visit([&](const auto& model) { return lower_model(model, color, lights); },
                      object.material.model);
}

/// u·P - u·point of the plane's own space, as a function of P in world space.
LoweredChecker lower_checker(const Plane& plane, const Mat4& transform, double size)
{
    const Mat3 inverse = glm::inverse(Mat3(transform));
    return {.point = Vec3(transform * glm::dvec4(plane.point, 1.0)),
            .u = (plane.u / size) * inverse,
            .v = (plane.v / size) * inverse};
}

void lower_lights(const Scene& scene, LoweredScene& lowered)
{
    for (Light light : scene.lights) {
        if (light.type == LightType::ambient)
            continue;
        // In models with unit rays, directions to lights are unit, too.
        if (light.type == LightType::directional && lowered.units == abi::RayUnits::unit)
            light.vector = glm::normalize(light.vector);
        lowered.lights.push_back(light);
    }
}

Rgb limit_color(const Scene& scene)
{
    const bool background = scene.illumination == Illumination::sketch ||
                            (scene.illumination == Illumination::general &&
                             scene.depth_limit == DepthLimit::background);
    return background ? scene.background : Rgb(0.0);
}

}  // namespace

std::int32_t RecentMaterials::index_of(const LoweredMaterial& material,
                                       std::vector<LoweredMaterial>& materials)
{
    const auto is_at = [&](std::int32_t index) {
        return index >= 0 && same(materials[static_cast<std::size_t>(index)], material);
    };
    // Neighbours often have the same material, and comparing costs less than a hash.
    if (is_at(latest_))
        return latest_;
    std::int32_t& index = indices_[hash_of(material) % remembered];
    if (!is_at(index)) {
        index = static_cast<std::int32_t>(materials.size());
        materials.push_back(material);
    }
    latest_ = index;
    return index;
}

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
        return {recent.index_of(first, lowered.materials), -1, number};

    const abi::MaterialIndex index{static_cast<std::int32_t>(lowered.materials.size()),
                                   static_cast<std::int32_t>(lowered.checkers.size()), number};
    lowered.checkers.push_back(lower_checker(*plane, object.transform, material.checker->size));
    lowered.materials.push_back(first);
    lowered.materials.push_back(lower_color(object, material.checker->other, lights));
    return index;
}

void lower_model_rules(const Scene& scene, LoweredScene& lowered)
{
    const bool scratch = scene.illumination == Illumination::scratch;
    lowered.background = scene.background;
    lowered.limit_color = limit_color(scene);
    lowered.max_depth = scene.max_depth;
    lowered.min_weight = least_traced_weight(scene.min_weight);
    lowered.shadows = scene.shadows != ShadowKind::none;
    lowered.visible_lights = scene.illumination == Illumination::sketch;
    lowered.units = scratch ? abi::RayUnits::as_given : abi::RayUnits::unit;
    // The other notes make highlights of lights behind the surface, too.
    lowered.highlights_behind =
        scene.illumination != Illumination::whitted && scene.illumination != Illumination::general;
    lowered.epsilon = note_epsilon;
    lowered.camera_t_min = scratch ? scratch_camera_t_min : note_epsilon;
    lower_lights(scene, lowered);
}

bool normal_faces_viewer(const Scene& scene, const Object& object)
{
    switch (scene.illumination) {
        case Illumination::shader:
            return false;
        case Illumination::scratch:
            return !std::holds_alternative<Sphere>(object.surface);
        default:
            return true;
    }
}

}  // namespace packtrace
