#include "lower/lower_model.hpp"

#include <variant>

#include <glm/geometric.hpp>

namespace packtrace {
namespace {

void lower_lights(const Scene& scene, LoweredScene& lowered)
{
    for (Light light : scene.lights) {
        if (light.type == LightType::ambient)
            continue;
        // Where rays are unit, so is the way to a light without a place.
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

void lower_model_rules(const Scene& scene, LoweredScene& lowered)
{
    const bool scratch = scene.illumination == Illumination::scratch;
    lowered.background = scene.background;
    lowered.limit_color = limit_color(scene);
    lowered.max_depth = scene.max_depth;
    lowered.min_weight = scene.min_weight;
    lowered.shadows = scene.shadows != ShadowKind::none;
    lowered.visible_lights = scene.illumination == Illumination::sketch;
    lowered.units = scratch ? abi::RayUnits::as_given : abi::RayUnits::unit;
    // The other notes' listings do not ask on which side of the surface the light is.
    lowered.highlights_behind =
        scene.illumination != Illumination::whitted && scene.illumination != Illumination::general;
    lowered.epsilon = 0.001;
    lowered.camera_t_min = scratch ? 1.0 : 0.001;
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
