#pragma once

#include "kernels/trace_stream.hpp"
#include "kernels/workspace.hpp"

// One tile of a picture, from camera rays to finished pixels.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Per point light, what may stand between it and the hit points.
template <class Real>
inline void find_blockers(const abi::SceneView<Real>& scene, const HitStream<Real>& hits,
                          SharedOriginObjects<Real>* blockers)
{
    if (!scene.shadows || hits.count == 0)
        return;
    const Box<Real> box = box_of(hits.point, hits.count);
    for (int i = 0; i < scene.lights.count; ++i) {
        const abi::LightRecord<Real>& light = scene.lights.data[i];
        if (light.kind == abi::LightKind::point)
            find_objects(blockers[i], segment_beam(light.vector, box), scene);
    }
}

template <class Real>
inline abi::RayCounts render_tile(const abi::TileJob<Real>& job)
{
    const abi::SceneView<Real>& scene = *job.scene;
    Workspace<Real> work(job.scratch, scene);
    TileMemory<Real>& memory = *work.memory;
    abi::RayCounts counts;

    // The first generation: camera rays against what the tile's beam may meet.
    find_objects(work.visible, camera_beam(job), scene);
    counts.camera = static_cast<unsigned>(job.width * job.height);
    fill_pixels(memory.color, scene.background);
    memory.hits.count = 0;
    if (!work.visible.empty())
        trace_camera(job, work.visible, memory);

    // Each generation is shaded into the pixels and leaves its mirrored rays to the next.
    for (int depth = 0; memory.hits.count > 0; ++depth) {
        const ShadeContext<Real> context{&scene, work.blockers, depth < scene.max_depth, &counts};
        RayStream<Real>& next = memory.rays;
        find_blockers(scene, memory.hits, work.blockers);
        if (depth == 0)
            shade_stream<PixelWrite::set>(context, memory.hits, memory.color, next);
        else
            shade_stream<PixelWrite::add>(context, memory.hits, memory.color, next);
        if (next.count == 0)
            break;
        counts.reflected += static_cast<unsigned>(next.count);
        trace_secondary(scene, next, memory);
    }
    for (int row = 0; row < job.height; ++row)
        write_row(job.rgb + row * job.row_stride, memory.color, row, job.width);
    return counts;
}

template <class Real>
inline void store_misses(abi::TileHits<Real>& hits)
{
    const HitPacket<Real> miss = no_hit<Real>(static_cast<Real>(__builtin_inf()));
    for (int first = 0; first < abi::tile_pixels; first += lanes<Real>) {
        store(hits.t + first, miss.t);
        store(hits.object + first, miss.object);
    }
}

template <class Real>
inline void closest_tile(const abi::TileJob<Real>& job, abi::TileHits<Real>& hits)
{
    const abi::SceneView<Real>& scene = *job.scene;
    Workspace<Real> work(job.scratch, scene);
    find_objects(work.visible, camera_beam(job), scene);
    if (work.visible.empty()) {
        store_misses(hits);
        return;
    }
    const TileCamera<Real> camera(job);
    for (int first = 0; first < abi::tile_pixels; first += lanes<Real>) {
        const RayPacket<Real> rays = camera_rays(camera, first);
        HitPacket<Real> hit = no_hit<Real>(static_cast<Real>(__builtin_inf()));
        closest_hit(hit, work.visible, rays);
        store(hits.t + first, hit.t);
        store(hits.object + first, hit.object);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
