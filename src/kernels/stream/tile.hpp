#pragma once

#include "kernels/geometry/cone.hpp"
#include "kernels/stream/bundle_shadow.hpp"
#include "kernels/stream/camera_rays.hpp"
#include "kernels/stream/shade_stream.hpp"
#include "kernels/stream/trace_stream.hpp"
#include "kernels/stream/workspace.hpp"

// One tile of a picture, from camera rays to finished pixels.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// What stays the same while a tile is rendered.
template <abi::Features F, class Real>
struct TileRun {
    const abi::SceneView<Real>& scene;
    Workspace<F, Real>& work;
    abi::RayCounts& counts;
};

/// Per light, what may stand between it and the hit points.
template <abi::Features F, class Real>
inline void find_occluders(const TileRun<F, Real>& run)
{
    // Where no light has shadows there is no room for their occluders either.
    if (run.work.occluders == nullptr)
        return;
    const abi::SceneView<Real>& scene = run.scene;
    const HitStream<F, Real>& hits = run.work.memory->hits;
    const Box<Real> box = box_of(hits.point, hits.count);
    for (int i = 0; i < scene.lighting.lights.count; ++i) {
        const abi::LightRecord<Real>& light = scene.lighting.lights.data[i];
        if (!light.casts_shadow)
            continue;
        run.counts.stages |= abi::stage_blockers;
        LightObjects<F, Real>& occluders = run.work.occluders[i];
        const abi::SceneView<Real>& casters = casters_of(scene);
        if (light.kind == abi::LightKind::point)
            find_objects<F>(occluders.from_point, segment_cone(light.vector, box), casters);
        else if constexpr (F.exact)
            filter_objects<F, false>(occluders.along, origins_in(box.low, box.high),
                                     parallel_cone(light.vector, box), casters);
        else
            find_parallel_candidates(list_of<Sphere>(occluders.from_point),
                                     parallel_cone(light.vector, box), casters.spheres);
    }
}

/// For a scene with a hierarchy, the surfaces at the hits, which every light's rays start from.
template <abi::Features F, class Real>
inline void find_surfaces(const TileRun<F, Real>& run)
{
    const HitStream<F, Real>& hits = run.work.memory->hits;
    for (int first = 0; first < hits.count; first += lanes<Real>)
        run.work.surfaces[first / lanes<Real>] =
            surface_of<F>(run.scene, hits, first, first_lanes<Real>(hits.count - first));
}

/// What the hits see of each light there.
template <abi::Features F, class Real>
inline void find_shadows(const TileRun<F, Real>& run, const ShadeContext<F, Real>& context)
{
    for (int light = 0; light < run.scene.lighting.lights.count; ++light)
        if (run.scene.lighting.lights.data[light].casts_shadow)
            find_shadows(context, run.work.memory->hits, light, *run.work.bundle,
                         run.work.shadows[light]);
}

/// Counts a chunk's children and puts them into one stream, mirrored rays first.
template <abi::Features F, class Real>
inline void join_children(const TileRun<F, Real>& run, RayStream<F, Real>& next, int depth)
{
    run.counts.reflected += static_cast<unsigned>(next.count);
    if (next.count > 0)
        run.counts.stages |= abi::stage_mirrored;
    if constexpr (F.glass) {
        begin_span(abi::Span::children, depth, abi::Part::children);
        if constexpr (F.probe)
            next.mirrored = next.count;
        const RayStream<F, Real>& refracted = *run.work.refracted;
        run.counts.refracted += static_cast<unsigned>(refracted.count);
        if (refracted.count > 0)
            run.counts.stages |= abi::stage_refracted;
        append_stream(next, refracted);
    }
}

/// Shades the chunk's hits, of rays after `depth` bounces, into the pixels, and gathers their
/// children in the stream of the next generation, which is returned; null when there are none.
template <abi::Features F, class Real>
inline RayStream<F, Real>* shade_chunk(const TileRun<F, Real>& run, PixelWrite write, int depth)
{
    const ShadeContext<F, Real> context{
        &run.scene, run.work.occluders, run.work.surfaces, run.work.shadows,
        depth,      &run.counts,        run.work.lacks};
    const HitStream<F, Real>& hits = run.work.memory->hits;
    if (hits.count == 0)
        return nullptr;
    tell_pixels(hits.pixel);
    run.counts.stages |= abi::stage_normals;
    if constexpr (F.exact)
        run.counts.stages |= abi::stage_refined;
    if (run.work.surfaces != nullptr) {
        begin_span(abi::Span::shade, depth, abi::Part::surface);
        find_surfaces(run);
    }
    begin_span(abi::Span::shadows, depth, abi::Part::beams);
    find_occluders(run);
    if (run.work.shadows != nullptr)
        find_shadows(run, context);
    begin_span(abi::Span::shade, depth, abi::Part::surface);
    RayStream<F, Real>* next = F.bounces && context.spawns() ? run.work.streams + depth : nullptr;
    if (next != nullptr)
        next->count = 0;
    if constexpr (F.glass)
        run.work.refracted->count = 0;
    shade_stream(write, context, hits, run.work.memory->color,
                 Children<F, Real>{next, run.work.refracted});
    if (next != nullptr)
        join_children(run, *next, depth);
    return next;
}

/// How many rays of a chunk are refracted; they stand behind the mirrored ones.
template <abi::Features F, class Real>
inline int refracted_rays(const RayStream<F, Real>& rays, int begin, int end)
{
    return rays.mirrored < begin ? end - begin : rays.mirrored < end ? end - rays.mirrored : 0;
}

/// Traces a generation chunk by chunk, each with all its descendants before the next: memory
/// grows with the depth, not with the number of rays.
template <abi::Features F, class Real>
void trace_generation(const TileRun<F, Real>& run, const RayStream<F, Real>& rays, int depth)
{
    for (int begin = 0; begin < rays.count; begin += chunk_rays) {
        const int end = begin + chunk_rays < rays.count ? begin + chunk_rays : rays.count;
        begin_span(abi::Span::trace, depth, abi::Part::ray_generation);
        tell_pixels(rays.pixel + begin);
        if constexpr (F.probe)
            tell_chunk(refracted_rays(rays, begin, end), end - begin);
        find_nearby<F, Real>(run.work.nearby,
                             {rays.org[0] + begin, rays.org[1] + begin, rays.org[2] + begin},
                             {rays.dir[0] + begin, rays.dir[1] + begin, rays.dir[2] + begin},
                             end - begin, run.scene);
        if (run.scene.tree.empty())
            trace_secondary(run.scene, rays, begin, end, run.work.nearby, *run.work.memory,
                            run.counts);
        else
            trace_secondary_bundle(run.scene, rays, begin, end, run.work.nearby, *run.work.bundle,
                                   *run.work.memory, run.counts);
        if (const auto* next = shade_chunk(run, PixelWrite::add, depth))
            trace_generation(run, *next, depth + 1);
    }
}

/// Shades the hits of camera rays, with all that comes from them.
template <abi::Features F, class Real>
inline void shade_camera(const TileRun<F, Real>& run)
{
    const HitStream<F, Real>& hits = run.work.memory->hits;
    run.counts.stages |= hits.count > 0 ? abi::stage_hits : 0u;
    if (!F.probe && run.scene.lighting.flat)
        return shade_flat(run.scene, hits, run.work.memory->color);
    const RayStream<F, Real>* next = shade_chunk(run, PixelWrite::set, 0);
    if constexpr (F.bounces)
        if (next != nullptr)
            trace_generation(run, *next, 1);
}

/// Asks for the cache lines of a tile's pixels, so that they are there when they are written.
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

/// The finished pixels, row by row, or the samples in their order.
template <class Real>
inline void write_tile(const abi::TileJob<Real>& job, const TilePixelColors<Real>& pixels)
{
    if (job.samples != nullptr) {
        for (int i = 0; i < job.samples->count; ++i)
            write_one(job.rgb + 3 * i, pixels + pixel_elements * i);
        return;
    }
    for (int row = 0; row < job.height; ++row)
        write_row(job.rgb + row * job.row_stride, pixels, row, job.width);
}

template <abi::Features F, class Real>
inline abi::RayCounts render_tile(const abi::TileJob<Real>& job)
{
    const abi::SceneView<Real>& scene = *job.scene;
    Workspace<F, Real> work(job.scratch, scene);
    TileMemory<F, Real>& memory = *work.memory;
    abi::RayCounts counts;
    counts.camera =
        static_cast<unsigned>(job.samples != nullptr ? job.samples->count : job.width * job.height);

    begin_observation(job.observation);
    fetch_picture(job);
    // Camera rays, against what the tile's cone may meet; a hit's first light replaces the
    // background.
    find_objects<F>(work.visible, camera_cone(job), scene);
    begin_span(abi::Span::film, 0, abi::Part::film);
    fill_pixels(memory.color, scene.rules.background);
    memory.hits.count = 0;
    for (int pixel = 0; work.lacks != nullptr && pixel < abi::tile_pixels; ++pixel)
        work.lacks[pixel] = 0.0;
    if constexpr (F.probe)
        memory.hits.probe = job.probe;
    begin_span(abi::Span::trace, 0, abi::Part::ray_generation);
    if (!scene.tree.empty()) {
        counts.stages |= abi::stage_hierarchy;
        trace_camera_bundle(job, work.visible, *work.bundle, memory, counts);
    } else if (is_probed<F>(job) || !work.visible.empty() || scene.lighting.seen_within > 0) {
        trace_camera(job, work.visible, memory, counts);
    } else {
        tell_untraced(counts.camera);
    }

    shade_camera(TileRun<F, Real>{scene, work, counts});
    begin_span(abi::Span::film, 0, abi::Part::film);
    write_tile(job, memory.color);
    if (work.lacks != nullptr)
        counts.lacks = most_lacking(work.lacks);
    end_observation();
    return counts;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
