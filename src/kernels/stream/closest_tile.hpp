#pragma once

#include "kernels/stream/camera_rays.hpp"
#include "kernels/stream/trace_stream.hpp"
#include "kernels/stream/workspace.hpp"

// The camera rays of a tile without any shading.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
inline void store_misses(abi::TileHits<Real>& hits)
{
    const HitPacket<Real> miss = no_hit<Real>(static_cast<Real>(__builtin_inf()));
    for (int first = 0; first < abi::tile_pixels; first += lanes<Real>) {
        store(hits.t + first, miss.t);
        store(hits.surface + first, miss.surface);
    }
}

/// With Features::exact each t is refined.
template <abi::Features F, class Real>
inline void store_tile_hits(abi::TileHits<Real>& hits, int first, const abi::SceneView<Real>& scene,
                            const RayPacket<Real>& rays, const HitPacket<Real>& hit)
{
    vreal<Real> t = hit.t;
    if constexpr (F.exact) {
        const std::uint32_t found = hit_lanes(hit);
        if (found != 0)
            t = select(from_bits<Real>(found),
                       refined<F, Refine::t>(scene.shapes, rays, hit, no_start<Real>(), found).t,
                       t);
    }
    store(hits.t + first, t);
    store(hits.surface + first, hit.surface);
}

template <abi::Features F, class Real>
inline void closest_tile(const abi::TileJob<Real>& job, abi::TileHits<Real>& hits)
{
    const abi::SceneView<Real>& scene = *job.scene;
    Arena arena(job.scratch);
    FromPoint<F, Real> visible;
    take_objects<F>(arena, visible, scene);
    find_objects<F>(visible, camera_cone(job), scene);
    if (!scene.tree.empty()) {
        auto& bundle = *arena.take<RayBundle<Real>>(1);
        gather_camera<F>(job, bundle);
        closest_of_bundle<F>(scene, visible, bundle);
        settle_camera_bundle<F>(scene, bundle);
        for (int first = 0; first < abi::tile_pixels; first += lanes<Real>)
            store_tile_hits<F>(hits, first, scene, load_rays(bundle, first),
                               load_hits(bundle, first));
        return;
    }
    if (visible.empty()) {
        store_misses(hits);
        return;
    }
    const TileCamera<Real> camera(job);
    for (int first = 0; first < abi::tile_pixels; first += lanes<Real>) {
        const RayPacket<Real> rays = camera_rays(camera, first, scene.rules.units);
        HitPacket<Real> hit = no_hit<Real>(static_cast<Real>(__builtin_inf()));
        closest_hit<F>(hit, visible, rays, NoOwn{});
        settle_packet<F>(scene, rays, hit, no_start<Real>(),
                         vreal<Real>(static_cast<Real>(__builtin_inf())), all_lanes<Real>);
        store_tile_hits<F>(hits, first, scene, rays, hit);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
