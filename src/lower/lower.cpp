#include "lower/lowered_scene.hpp"

#include <string>

#include <packtrace/read_scene.hpp>

#include "lower/lower_material.hpp"
#include "lower/lower_surface.hpp"

namespace packtrace {
namespace {

Rgb ambient_light(const Scene& scene)
{
    Rgb sum{0.0};
    for (const Light& light : scene.lights)
        if (light.type == LightType::ambient)
            sum += light.intensity;
    return sum;
}

void lower_lights(const Scene& scene, LoweredScene& lowered)
{
    for (const Light& light : scene.lights)
        if (light.type != LightType::ambient)
            lowered.lights.push_back(light);
}

}  // namespace

LoweredScene lower(const Scene& scene)
{
    LoweredScene lowered;
    lowered.background = scene.background;
    lowered.max_depth = scene.max_depth;
    lowered.shadows = scene.shadows != ShadowKind::none;
    lowered.epsilon = 0.001;
    lowered.camera_t_min = 1.0;
    lower_lights(scene, lowered);

    const Rgb ambient = ambient_light(scene);
    for (const Object& object : scene.objects) {
        lower_surface(object, static_cast<std::int32_t>(lowered.material_index.size()), lowered);
        lower_material(object, ambient, lowered);
    }
    mark_huge_spheres(scene.camera.position, lowered);
    return lowered;
}

}  // namespace packtrace
