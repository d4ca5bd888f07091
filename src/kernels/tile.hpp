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
inline void clear_pixels(const abi::SceneView<Real>& scene, TileMemory<Real>& memory)
{
    for (auto& pixel : memory.color)
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = scene.background[channel];
}

/// Pixels whose camera ray hit something start from nothing instead of the background.
template <class Real>
inline void clear_hit_pixels(TileMemory<Real>& memory)
{
    for (int i = 0; i < memory.hits.count; ++i)
        for (int channel = 0; channel < 3; ++channel)
            memory.color[memory.hits.pixel[i]][channel] = 0;
}

/// Every second bit position of `number` filled from its low bits.
constexpr int spread_bits(int number)
{
    return (number & 1) | ((number & 2) << 1) | ((number & 4) << 2) | ((number & 8) << 3);
}

template <class Real>
inline void write_pixels(const abi::TileJob<Real>& job, const TileMemory<Real>& memory)
{
    for (int row = 0; row < job.height; ++row) {
        Real* to = job.rgb + row * job.row_stride;
        const int row_bits = spread_bits(row) << 1;
        for (int column = 0; column < job.width; ++column, to += 3) {
            const Real* from = memory.color[row_bits | spread_bits(column)];
            to[0] = from[0];
            to[1] = from[1];
            to[2] = from[2];
        }
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
    clear_pixels(scene, memory);
    memory.hits.count = 0;
    if (!work.visible.empty())
        trace_camera(job, work.visible, memory);
    clear_hit_pixels(memory);

    // Each generation is shaded into the pixels and leaves its mirrored rays to the next.
    for (int depth = 0; memory.hits.count > 0; ++depth) {
        const bool spawn = depth < scene.max_depth;
        RayStream<Real>& next = memory.rays[depth & 1];
        find_blockers(scene, memory.hits, work.blockers);
        shade_stream<Real>({&scene, work.blockers, spawn, &counts}, memory.hits, memory.color,
                           next);
        if (next.count == 0)
            break;
        counts.reflected += static_cast<unsigned>(next.count);
        trace_secondary(scene, next, memory);
    }
    write_pixels(job, memory);
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
