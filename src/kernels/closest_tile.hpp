#pragma once

#include "kernels/camera_beam.hpp"
#include "kernels/trace_stream.hpp"
#include "kernels/workspace.hpp"

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

template <abi::Features F, class Real>
inline void closest_tile(const abi::TileJob<Real>& job, abi::TileHits<Real>& hits)
{
    const abi::SceneView<Real>& scene = *job.scene;
    Arena arena(job.scratch);
    SharedOriginObjects<Real> visible = take_objects(arena, scene);
    find_objects<F>(visible, camera_beam(job), scene);
    if (!scene.tree.empty()) {
        auto& group = *arena.take<RayGroup<Real>>(1);
        gather_camera(job, group);
        closest_of_group<F>(scene, visible, group);
        __builtin_memcpy(hits.t, group.t, sizeof hits.t);
        __builtin_memcpy(hits.surface, group.surface, sizeof hits.surface);
        return;
    }
    if (visible.empty()) {
        store_misses(hits);
        return;
    }
    const TileCamera<Real> camera(job);
    for (int first = 0; first < abi::tile_pixels; first += lanes<Real>) {
        const RayPacket<Real> rays = camera_rays(camera, first, scene.units);
        HitPacket<Real> hit = no_hit<Real>(static_cast<Real>(__builtin_inf()));
        closest_hit<F>(hit, visible, rays);
        store(hits.t + first, hit.t);
        store(hits.surface + first, hit.surface);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
