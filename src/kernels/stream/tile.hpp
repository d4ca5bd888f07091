#pragma once

#include "kernels/bvh/pick_spheres.hpp"
#include "kernels/stream/camera_rays.hpp"
#include "kernels/stream/chunk.hpp"

// Renders tiles of a picture, from camera rays to finished pixels.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Traces a generation chunk by chunk, each with all its descendants before the next. So memory
/// grows with the depth, not with the number of rays.
template <abi::Features F, class Real>
void trace_generation(const TileRun<F, Real>& run, const RayStream<F, Real>& rays, int depth)
{
    for (int begin = 0; begin < rays.count; begin += chunk_rays) {
        const int end = begin + chunk_rays < rays.count ? begin + chunk_rays : rays.count;
        if (const auto* next = trace_chunk(run, rays, begin, end, depth, run.work.streams + depth))
            trace_generation(run, *next, depth + 1);
    }
}

/// 1 for a stream that contains rays, else 0.
template <abi::Features F, class Real>
inline int has_rays(const RayStream<F, Real>* stream)
{
    return stream != nullptr && stream->count > 0 ? 1 : 0;
}

/// Traces the generations of several tiles, sorted, one generation after another. Only mirrors make
/// child rays here, so a pixel has one ray per generation, and its light is added in the same order
/// as by trace_generation().
template <abi::Features F, class Real>
void trace_sorted(const TileRun<F, Real>& run, int streams)
{
    SortedWork<F, Real>& sorted = *run.work.sorted;
    RayStream<F, Real>* from = sorted.streams[0];
    RayStream<F, Real>* to = sorted.streams[1];
    for (int depth = 1; streams > 0; ++depth) {
        begin_stage(abi::Stage::children, depth - 1, abi::Step::children);
        const int rays = sort_rays(sorted, from, streams);
        streams = 0;
        for (int begin = 0; begin < rays; begin += chunk_rays) {
            const int count = rays - begin < chunk_rays ? rays - begin : chunk_rays;
            begin_stage(abi::Stage::children, depth - 1, abi::Step::children);
            gather_rays(*run.work.streams, from, sorted.order + begin, count);
            streams += has_rays(trace_chunk(run, *run.work.streams, 0, count, depth, to + streams));
        }
        std::swap(from, to);
    }
}

/// Shades the hits of camera rays, and collects their child rays as shade_chunk() does.
template <abi::Features F, class Real>
inline RayStream<F, Real>* shade_camera(const TileRun<F, Real>& run, RayStream<F, Real>* next)
{
    const HitStream<F, Real>& hits = run.work.memory->hits;
    run.counts.passed |= hits.count > 0 ? abi::passed_hits : 0u;
    if (F.probe || !run.scene.lighting.flat)
        return shade_chunk(run, PixelWrite::set, 0, next);
    shade_flat(run.scene, hits, run.work.memory->color);
    return nullptr;
}

/// Prefetches the cache lines of a tile's pixels in the picture.
template <class Real>
inline void fetch_picture(const abi::TileJob<Real>& job)
{
    if (job.samples != nullptr)
        return;
    constexpr int line = 64 / sizeof(Real);
    for (int row = 0; row < job.height; ++row)
        for (int element = 0; element < 3 * job.width; element += line)
            __builtin_prefetch(job.rgb + row * job.row_stride + element, 1);
}

/// Writes the finished pixels row by row, or the samples in their order.
template <class Real>
inline void write_tile(const abi::TileJob<Real>& job, const Real* pixels)
{
    if (job.samples != nullptr) {
        for (int i = 0; i < job.samples->count; ++i)
            write_one(job.rgb + 3 * i, pixels + pixel_elements * i);
        return;
    }
    for (int row = 0; row < job.height; ++row)
        write_row(job.rgb + row * job.row_stride, pixels, row, job.width);
}

/// Traces the camera rays of a tile. Its first pixel has the number `first_pixel` among the pixels
/// of all tiles.
template <abi::Features F, class Real>
inline void trace_camera_of_tile(const TileRun<F, Real>& run, const abi::TileJob<Real>& job,
                                 int first_pixel)
{
    const auto& [scene, work, counts] = run;
    TileMemory<F, Real>& memory = *work.memory;
    const int rays = job.samples != nullptr ? job.samples->count : job.width * job.height;
    counts.camera += static_cast<unsigned>(rays);
    // Rays are tested against the objects that the tile's cone may hit. The first light of a hit
    // replaces the background.
    const Cone<Real> cone = camera_cone(job);
    find_objects<F>(work.visible, cone, scene);
    const bool are_all = picks_all<F>(work.visible, cone, scene);
    sort_by_distance<F>(work.visible);
    begin_stage(abi::Stage::film, 0, abi::Step::film);
    fill_pixels(memory.color + pixel_elements * first_pixel, scene.rules.background);
    memory.hits.count = 0;
    if constexpr (F.probe)
        memory.hits.probe = job.probe;
    begin_stage(abi::Stage::trace, 0, abi::Step::ray_generation);
    if (!scene.tree.empty())
        counts.passed |= abi::passed_hierarchy;
    if (!are_all) {
        trace_camera_bundle(job, first_pixel, work.visible, *work.bundle, memory, counts);
    } else if (is_probed<F>(job) || !work.visible.empty() || scene.lighting.seen_within > 0) {
        trace_camera(job, first_pixel, work.visible, memory, counts);
    } else {
        record_untraced(static_cast<std::uint64_t>(rays));
    }
}

/// Renders up to abi::block_tiles tiles of one frame. With several tiles, reflected rays are traced
/// together; the scene must have no glass then.
template <abi::Features F, class Real>
inline abi::RayCounts render_tiles(const abi::TileJob<Real>* tiles, int count)
{
    const abi::SceneView<Real>& scene = *tiles->scene;
    Workspace<F, Real> work(tiles->scratch, scene, count);
    abi::RayCounts counts;
    const TileRun<F, Real> run{scene, work, counts};
    begin_observation(tiles->observation);
    for (int pixel = 0; work.lacks != nullptr && pixel < count * abi::tile_pixels; ++pixel)
        work.lacks[pixel] = 0.0;
    int streams = 0;
    for (int tile = 0; tile < count; ++tile) {
        fetch_picture(tiles[tile]);
        trace_camera_of_tile(run, tiles[tile], tile * abi::tile_pixels);
        RayStream<F, Real>* const next =
            work.sorted != nullptr ? work.sorted->streams[0] + streams : work.streams;
        streams += has_rays(shade_camera(run, next));
    }
    if (work.sorted != nullptr)
        trace_sorted(run, streams);
    else if (streams > 0)
        trace_generation(run, *work.streams, 1);
    begin_stage(abi::Stage::film, 0, abi::Step::film);
    for (int tile = 0; tile < count; ++tile)
        write_tile(tiles[tile], work.memory->color + tile_elements * tile);
    if (work.lacks != nullptr)
        counts.lacks = most_lacking(work.lacks, count * abi::tile_pixels);
    end_observation();
    return counts;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
