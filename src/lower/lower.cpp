#include "lower/eye_glass.hpp"
#include "lower/lower_material.hpp"
#include "lower/lower_model.hpp"
#include "lower/lower_surface.hpp"
#include "lower/lowered_scene.hpp"
#include "lower/stiffness.hpp"

namespace packtrace {
namespace {

bool any_glass(const LoweredScene& lowered)
{
    for (const LoweredMaterial& material : lowered.materials)
        if (material.transmit != Rgb(0.0))
            return true;
    return false;
}

void lower_objects(const Scene& scene, LoweredScene& lowered)
{
    const LightSums lights = sum_lights(scene);
    std::int32_t number = 0;
    for (const Object& object : scene.objects) {
        const auto index = lower_material(object, number++, lights, lowered);
        const auto first = static_cast<std::int32_t>(lowered.material_index.size());
        const int pieces = lower_surface(object, first, lowered);
        for (int piece = 0; piece < pieces; ++piece) {
            lowered.material_index.push_back(index);
            lowered.faces_viewer.push_back(normal_faces_viewer(scene, object));
        }
    }
}

}  // namespace

LoweredScene lower(const Scene& scene, Accuracy accuracy, SelfHits self_hits)
{
    LoweredScene lowered;
    lower_model_rules(scene, lowered);
    lower_objects(scene, lowered);
    mark_huge_spheres(scene.camera.position, lowered);
    mark_stiff(accuracy, lowered);
    mark_finished(accuracy, self_hits, lowered);
    lowered.precise_powers = accuracy == Accuracy::robust;
    lowered.self_hits = self_hits;

    lowered.features.quadrics = !lowered.quadrics.empty();
    lowered.features.glass = any_glass(lowered);
    lowered.transparent_shadows =
        scene.shadows == ShadowKind::transparent && lowered.features.glass;
    if (lowered.features.glass)
        lowered.eye_inside = glass_around(scene.camera.position, scene.camera.rotation[2], lowered);
    return lowered;
}

}  // namespace packtrace
