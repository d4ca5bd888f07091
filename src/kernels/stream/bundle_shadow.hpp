#pragma once

#include "kernels/bvh/bvh_occluded.hpp"
#include "kernels/shade/shadow.hpp"
#include "kernels/stream/tile_memory.hpp"

// Shadow rays of a chunk of hits as one bundle per light, for scenes with a BVH.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Fills a bundle with the shadow rays between the hits and one light that can add light to them.
/// Calls `keeps_own(first, lanes)` with the lanes of each packet that their own object occludes; it
/// returns the lanes that need no further occluders.
template <abi::Features F, class Real, class KeepsOwn>
inline void gather_shadow_rays(const ShadeContext<F, Real>& context, const HitStream<F, Real>& hits,
                               int light, RayBundle<Real>& bundle, const KeepsOwn& keeps_own)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const abi::LightRecord<Real>& record = scene.lighting.lights.data[light];
    LastMaterials<Real> materials;
    for (int first = 0; first < hits.count; first += lanes<Real>) {
        const std::uint32_t active = first_lanes<Real>(hits.count - first);
        const SurfacePacket<Real>& surface = context.surfaces[first / lanes<Real>];
        const MaterialPacket<Real>& material = materials.fetch(scene, surface, active);
        const LightPacket<Real> packet = light_at(scene, record, surface, material, active);
        with_shadow_ray(scene, record, packet, surface,
                        [&](const vreal<Real>& t_end, const RayPacket<Real>& rays) {
                            start_segments<F>(bundle, first, rays, t_end, own_of(scene, surface),
                                              packet.wanted);
                        });
        const std::uint32_t by_own = own_shadow(scene, record, packet, surface, packet.wanted);
        if (by_own != 0)
            finish_lanes(bundle, first, keeps_own(first, by_own));
    }
    end_bundle(bundle, hits.count);
}

/// The light buffer of a light; null if it has none.
template <class Real>
inline const abi::LightBuffer* light_buffer(const abi::SceneView<Real>& casters, int light)
{
    const abi::LightBuffer* const buffers = casters.lighting.buffers;
    return buffers != nullptr && buffers[light].cells != nullptr ? buffers + light : nullptr;
}

template <abi::Features F, class Real>
inline void visit_shadow_occluders(const ShadeContext<F, Real>& context, int light,
                                   RayBundle<Real>& bundle, const Occluder& occluder)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const abi::SceneView<Real>& casters = casters_of(scene);
    const RayInterval interval = shadow_interval(scene, scene.lighting.lights.data[light]);
    with_light_objects(context, light, [&](const auto& objects) {
        visit_occluders_of_bundle<F>(casters, objects, bundle, interval, occluder,
                                     light_buffer(casters, light));
    });
}

/// Decides in double the active rays of a bundle that may be occluded. `start_again(first, lanes)`
/// resets the result of such rays of a packet.
template <abi::Features F, class Real, class StartAgain>
inline void decide_shadow_bundle(const ShadeContext<F, Real>& context, int light,
                                 RayBundle<Real>& bundle, const Occluder& occluder,
                                 const StartAgain& start_again)
{
    if constexpr (F.exact) {
        WideBundle wide;
        add_unsure_segments(wide, bundle, start_again);
        if (wide.count == 0)
            return;
        context.counts->unsure += static_cast<unsigned>(wide.count);
        for (int i = 0; i < wide.count; ++i)
            count_unsure_shadow(wide.from[i]);
        const abi::SceneView<Real>& scene = *context.scene;
        block_wide<F.probe>(*casters_of(scene).wide, wide,
                            shadow_interval(scene, scene.lighting.lights.data[light]),
                            scene.lighting.transparent_shadows ? Occluders::all : Occluders::any,
                            [&](int ray, std::int32_t surface) {
                                const int first = ray / lanes<Real> * lanes<Real>;
                                const std::uint32_t lane = 1u << (ray - first);
                                const std::uint32_t done = occluder(surface, first, lane);
                                finish_lanes(bundle, first, done);
                                return done != 0;
                            });
    }
}

template <class Real>
inline void copy_active(const RayBundle<Real>& bundle, std::uint16_t (&to)[bundle_cells])
{
    for (int cell = 0; cell < bundle_cells; ++cell)
        to[cell] = bundle.active[cell];
}

/// Computes the shadows of one light if occluders transmit a share of it.
template <abi::Features F, class Real>
inline void find_shares(const ShadeContext<F, Real>& context, const HitStream<F, Real>& hits,
                        int light, RayBundle<Real>& bundle, LightShadows<F, Real>& shadows)
{
    const abi::SceneView<Real>& scene = *context.scene;
    for (Real(&channel)[bundle_rays] : shadows.share)
        for (Real& share : channel)
            share = Real(1);
    std::uint32_t by_own[bundle_rays / lanes<Real>] = {};
    const auto dim_by_own = [&](int first, std::uint32_t own) {
        std::uint32_t dark = 0;
        for_each_distinct<Real>(
            load(bundle.own + first), own, [&](lane_int<Real> surface, vmask<Real> same) {
                dark |=
                    shadows.dim(scene, static_cast<std::int32_t>(surface), first, bits(same) & own);
            });
        return dark;
    };
    gather_shadow_rays(context, hits, light, bundle, [&](int first, std::uint32_t own) {
        by_own[first / lanes<Real>] = own;
        return dim_by_own(first, own);
    });
    const auto pass_on = [&](std::int32_t surface, int first, std::uint32_t blocked) {
        return shadows.dim(scene, surface, first, blocked);
    };
    visit_shadow_occluders<F>(context, light, bundle, Occluder(pass_on));
    decide_shadow_bundle<F>(context, light, bundle, Occluder(pass_on),
                            [&](int first, std::uint32_t lanes_of) {
                                shadows.brighten(first, lanes_of);
                                dim_by_own(first, by_own[first / lanes<Real>] & lanes_of);
                            });
    copy_active(bundle, shadows.lit);
}

/// Computes the shadows of one light: which hits it reaches, and with which share.
template <abi::Features F, class Real>
inline void find_shadows(const ShadeContext<F, Real>& context, const HitStream<F, Real>& hits,
                         int light, RayBundle<Real>& bundle, LightShadows<F, Real>& shadows)
{
    const ShadowScope shadow(abi::Step::ray_generation);
    if constexpr (F.glass)
        if (context.scene->lighting.transparent_shadows)
            return find_shares(context, hits, light, bundle, shadows);
    gather_shadow_rays(context, hits, light, bundle, [](int, std::uint32_t own) { return own; });
    visit_shadow_occluders<F>(context, light, bundle, Occluder());
    decide_shadow_bundle<F>(context, light, bundle, Occluder(), [](int, std::uint32_t) {});
    copy_active(bundle, shadows.lit);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
