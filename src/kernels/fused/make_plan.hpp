#pragma once

#include "kernels/fused/make_clear_tests.hpp"

// Makes the plan of a frame (plan.hpp). All bounds are computed in double, once per frame.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <abi::Features F>
inline void fill_materials(FramePlan<F>& plan, const abi::SceneView<float>& scene)
{
    const auto count = static_cast<std::int32_t>(FramePlan<F>::material_count(scene));
    for (std::int32_t i = 0; i < count; ++i) {
        PlanMaterial& material = plan.materials[i];
        material.packet = fetch_materials(scene, vint<float>(i), all_lanes<float>);
        material.floor2 = shine_floor2(material.packet);
        material.reflects = any_channel(material.packet.reflect) != 0;
    }
}

template <abi::Features F>
inline void fill_surfaces(FramePlan<F>& plan, const abi::SceneView<float>& scene)
{
    PlanSurface& any = plan.surfaces[-1] = {};
    FramePlan<F>::for_each_surface(scene, [&](std::int32_t number) {
        PlanSurface& surface = plan.surfaces[number] = {};
        const abi::MaterialIndex& index = scene.materials.of_surface[number];
        if (index.checker < 0)
            surface.material = plan.materials + index.first;
        surface.met_again =
            hit_again(scene.shapes, scene.shapes.index[number]) == HitAgain::from_anywhere;
        any.met_again |= surface.met_again;
    });
}

/// Prepares the objects for rays from `origins`; in fast mode, which has no error bounds, for rays
/// from anywhere.
template <abi::Features F>
inline void find_from_near(FromAnywhere<F, float>& objects, const Origins& origins,
                           const abi::SceneView<float>& scene)
{
    if constexpr (F.exact)
        find_objects<F>(objects, origins, scene);
    else
        find_objects<F>(objects, Cone<float>{}, scene);
}

/// Fills a plan whose arrays have memory.
template <abi::Features F>
inline void fill_plan(FramePlan<F>& plan, const abi::SceneView<float>& scene,
                      const abi::CameraView<float>& camera)
{
    if constexpr (F.exact) {
        find_from_point<F, float>(plan.from_camera, camera.origin, scene);
        sort_by_distance<F>(plan.from_camera);
    }
    plan.origins = near_origins(scene, camera.origin, camera.origin);
    find_from_near<F>(plan.from_near, plan.origins, scene);
    fill_common(plan.common, scene, plan.origins, camera.origin);
    fill_materials(plan, scene);
    fill_surfaces(plan, scene);
    const abi::SceneView<float>& casters = casters_of(scene);
    for (int i = 0; i < scene.lighting.lights.count; ++i) {
        const abi::LightRecord<float>& light = scene.lighting.lights.data[i];
        PlanLight& planned = plan.lights.first[i];
        planned.record = light;
        planned.number = i;
        make_clear_tests<F>(planned.clear, scene, light, plan.origins);
        find_all_needed<F>(planned.clear, scene, light);
        if (!light.casts_shadow)
            continue;
        if (light.sends_rays)
            find_from_point<F, float>(plan.occluders[i].from_point, light.vector, casters);
        else
            find_from_near<F>(plan.occluders[i].along, plan.origins, casters);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
