#pragma once

#include "kernels/shadow.hpp"
#include "kernels/tree_blockers.hpp"

// Shadow rays of a whole chunk of hits at once, where the scene has a hierarchy: one beam from
// the light, or along it.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Fills a group with the rays between the hits and one light that can add anything to them, and
/// calls `keeps_own(first, lanes)` for those of each packet that their own surface is in the way
/// of; it returns the lanes that nothing further matters to.
template <abi::Features F, class Real, class KeepsOwn>
inline void gather_shadow_rays(const ShadeContext<F, Real>& context, const HitStream<F, Real>& hits,
                               int light, RayGroup<Real>& group, const KeepsOwn& keeps_own)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const abi::LightRecord<Real>& record = scene.lights.data[light];
    for (int first = 0; first < hits.count; first += lanes<Real>) {
        const std::uint32_t active = first_lanes<Real>(hits.count - first);
        const SurfacePacket<Real>& surface = context.surfaces[first / lanes<Real>];
        const MaterialPacket<Real> material = fetch_materials(scene, surface.material, active);
        const LightPacket<Real> packet = light_at<F>(scene, record, surface, material, active);
        with_shadow_ray(context, light, packet, surface,
                        [&](const vreal<Real>& t_end, const RayPacket<Real>& rays) {
                            store_rays(group, first, rays);
                            HitPacket<Real> none = no_hit<Real>(Real(0));
                            none.t = t_end;
                            start_rays<F>(group, first, none, own_of(scene, surface),
                                          packet.wanted);
                        });
        const std::uint32_t by_own = own_shadow(scene, record, packet, surface, packet.wanted);
        if (by_own != 0)
            finish_lanes(group, first, keeps_own(first, by_own));
    }
    end_group(group, hits.count);
}

template <abi::Features F, class Real, class Blocker>
inline void visit_shadow_blockers(const ShadeContext<F, Real>& context, int light,
                                  RayGroup<Real>& group, const Blocker& blocker)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const abi::SceneView<Real>& casters = casters_of(scene);
    const bool closed = has_closed_reach(scene, light);
    with_light_objects(context, light, [&](const auto& objects) {
        visit_blockers_of_group<F>(casters, objects, group, closed, blocker);
    });
}

/// Looks again, in double, at the active rays of a group that something may be in the way of.
/// `start_again(first, lanes)` takes back what is known of those of a packet.
template <abi::Features F, class Real, class Blocker, class StartAgain>
inline void settle_shadow_group(const ShadeContext<F, Real>& context, int light,
                                RayGroup<Real>& group, const Blocker& blocker,
                                const StartAgain& start_again)
{
    if constexpr (F.exact) {
        WideGroup wide;
        for (int first = 0; first < group_rays; first += lanes<Real>) {
            const std::uint32_t unsure = unsure_of(group, first) & active_lanes(group, first);
            if (unsure == 0)
                continue;
            add_segments(wide, first, load_rays(group, first), load(group.own + first),
                         load(group.t + first), unsure);
            start_again(first, unsure);
        }
        if (wide.count == 0)
            return;
        context.counts->unsure += static_cast<unsigned>(wide.count);
        for (int i = 0; i < wide.count; ++i)
            count_unsure_shadow(wide.from[i]);
        block_wide<F>(*casters_of(*context.scene).wide, wide,
                      has_closed_reach(*context.scene, light),
                      context.scene->transparent_shadows ? Blockers::all : Blockers::any,
                      [&](int ray, std::int32_t surface) {
                          const int first = ray / lanes<Real> * lanes<Real>;
                          const std::uint32_t lane = 1u << (ray - first);
                          const std::uint32_t done = blocker(surface, first, lane);
                          finish_lanes(group, first, done);
                          return done != 0;
                      });
    }
}

template <class Real>
inline void copy_active(const RayGroup<Real>& group, std::uint16_t (&to)[group_cells])
{
    for (int cell = 0; cell < group_cells; ++cell)
        to[cell] = group.active[cell];
}

/// Fills the shadows of one light where blockers pass on a share of it.
template <abi::Features F, class Real>
inline void find_shares(const ShadeContext<F, Real>& context, const HitStream<F, Real>& hits,
                        int light, RayGroup<Real>& group, LightShadows<F, Real>& shadows)
{
    const abi::SceneView<Real>& scene = *context.scene;
    for (Real(&channel)[group_rays] : shadows.share)
        for (Real& share : channel)
            share = Real(1);
    std::uint32_t by_own[group_rays / lanes<Real>] = {};
    const auto dim_by_own = [&](int first, std::uint32_t own) {
        std::uint32_t dark = 0;
        for_each_distinct<Real>(
            load(group.own + first), own, [&](lane_int<Real> surface, vmask<Real> same) {
                dark |=
                    shadows.dim(scene, static_cast<std::int32_t>(surface), first, bits(same) & own);
            });
        return dark;
    };
    gather_shadow_rays(context, hits, light, group, [&](int first, std::uint32_t own) {
        by_own[first / lanes<Real>] = own;
        return dim_by_own(first, own);
    });
    const auto pass_on = [&](std::int32_t surface, int first, std::uint32_t blocked) {
        return shadows.dim(scene, surface, first, blocked);
    };
    visit_shadow_blockers<F>(context, light, group, pass_on);
    settle_shadow_group<F>(context, light, group, pass_on, [&](int first, std::uint32_t lanes_of) {
        shadows.brighten(first, lanes_of);
        dim_by_own(first, by_own[first / lanes<Real>] & lanes_of);
    });
    copy_active(group, shadows.lit);
}

/// Fills the shadows of one light: which hits see it, and through how much.
template <abi::Features F, class Real>
inline void find_shadows(const ShadeContext<F, Real>& context, const HitStream<F, Real>& hits,
                         int light, RayGroup<Real>& group, LightShadows<F, Real>& shadows)
{
    const ShadowScope shadow(abi::Part::ray_generation);
    if constexpr (F.glass)
        if (context.scene->transparent_shadows)
            return find_shares(context, hits, light, group, shadows);
    gather_shadow_rays(context, hits, light, group, [](int, std::uint32_t own) { return own; });
    visit_shadow_blockers<F>(context, light, group, EndsRays{});
    settle_shadow_group<F>(context, light, group, EndsRays{}, [](int, std::uint32_t) {});
    copy_active(group, shadows.lit);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
