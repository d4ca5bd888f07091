#pragma once

#include "kernels/shadow.hpp"
#include "kernels/tree_blockers.hpp"

// Shadow rays of a whole chunk of hits at once, where the scene has a hierarchy: one beam from
// the light, or along it.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Fills a group with the rays between the hits and one light that can add anything to them.
template <abi::Features F, class Real>
inline void gather_shadow_rays(const ShadeContext<F, Real>& context, const HitStream<F, Real>& hits,
                               int light, RayGroup<Real>& group)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const abi::LightRecord<Real>& record = scene.lights.data[light];
    for (int first = 0; first < hits.count; first += lanes<Real>) {
        const std::uint32_t active = first_lanes<Real>(hits.count - first);
        const SurfacePacket<Real> surface = surface_of<F>(scene, hits, first, active);
        const MaterialPacket<Real> material = fetch_materials(scene, surface.material, active);
        const LightPacket<Real> packet = light_at<F>(record, surface, material, active);
        with_shadow_ray(context, light, packet, surface,
                        [&](const vreal<Real>& t_end, const RayPacket<Real>& rays) {
                            store_rays(group, first, rays);
                            start_rays(group, first, t_end, packet.wanted);
                        });
    }
    end_group(group, hits.count);
}

template <abi::Features F, class Real, class Blocker>
inline void visit_shadow_blockers(const ShadeContext<F, Real>& context, int light,
                                  RayGroup<Real>& group, const Blocker& blocker)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const abi::SceneView<Real>& casters = casters_of(scene);
    if (scene.lights.data[light].kind == abi::LightKind::directional)
        visit_blockers_of_group<F, NoEnd<Real>>(casters, casters, group, blocker);
    else if (scene.start_error > 0)
        visit_blockers_of_group<F, StreamRange<Real>>(casters, context.blockers[light], group,
                                                      blocker);
    else
        visit_blockers_of_group<F, SegmentEnd<Real>>(casters, context.blockers[light], group,
                                                     blocker);
}

template <class Real>
inline void copy_active(const RayGroup<Real>& group, std::uint16_t (&to)[group_cells])
{
    for (int cell = 0; cell < group_cells; ++cell)
        to[cell] = group.active[cell];
}

/// Fills the shadows of one light: which hits see it, and through how much.
template <abi::Features F, class Real>
inline void find_shadows(const ShadeContext<F, Real>& context, const HitStream<F, Real>& hits,
                         int light, RayGroup<Real>& group, LightShadows<F, Real>& shadows)
{
    const ShadowScope shadow(abi::Part::ray_generation);
    gather_shadow_rays(context, hits, light, group);
    if constexpr (F.glass) {
        if (context.scene->transparent_shadows) {
            for (Real(&channel)[group_rays] : shadows.share)
                for (Real& share : channel)
                    share = Real(1);
            const auto pass_on = [&](std::int32_t surface, int first, std::uint32_t blocked) {
                return shadows.dim(*context.scene, surface, first, blocked);
            };
            visit_shadow_blockers<F>(context, light, group, pass_on);
            copy_active(group, shadows.lit);
            return;
        }
    }
    visit_shadow_blockers<F>(context, light, group, EndsRays{});
    copy_active(group, shadows.lit);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
