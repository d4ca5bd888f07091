#pragma once

#include "kernels/bvh/pick_spheres.hpp"
#include "kernels/geometry/cone.hpp"
#include "kernels/stream/bundle_shadow.hpp"
#include "kernels/stream/shade_stream.hpp"
#include "kernels/stream/trace_stream.hpp"
#include "kernels/stream/workspace.hpp"

// Processes a chunk of rays of one generation: closest hits, their light, and the child rays.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The state shared by the tiles that are rendered together.
template <abi::Features F, class Real>
struct TileRun {
    const abi::SceneView<Real>& scene;
    Workspace<F, Real>& work;
    abi::RayCounts& counts;
};

/// Finds the possible occluders between each light and the hits. Returns whether all of them are in
/// lists.
template <abi::Features F, class Real>
inline bool find_occluders(const TileRun<F, Real>& run)
{
    // If no light has shadows, there is no memory for occluders either.
    if (run.work.occluders == nullptr)
        return true;
    bool by_lists = true;
    const abi::SceneView<Real>& scene = run.scene;
    const HitStream<F, Real>& hits = run.work.memory->hits;
    const Box<Real> box = box_of(hits.point, hits.count);
    for (int i = 0; i < scene.lighting.lights.count; ++i) {
        const abi::LightRecord<Real>& light = scene.lighting.lights.data[i];
        if (!light.casts_shadow)
            continue;
        run.counts.passed |= abi::passed_occluders;
        LightObjects<F, Real>& occluders = run.work.occluders[i];
        const abi::SceneView<Real>& casters = casters_of(scene);
        if (light.sends_rays) {
            const Cone<Real> cone = segment_cone(light.vector, box);
            find_objects<F>(occluders.from_point, cone, casters);
            occluders.are_all = picks_all<F>(occluders.from_point, cone, casters);
        } else {
            const Cone<Real> cone = cone_along(box, light);
            find_nearby<F>(occluders.along, box, cone, casters);
            occluders.are_all = picks_all<F>(occluders.along, box, cone, casters);
        }
        by_lists &= occluders.are_all;
    }
    return by_lists;
}

/// With a BVH: computes the surfaces at the hits, which the shadow rays of all lights start from.
template <abi::Features F, class Real>
inline void find_surfaces(const TileRun<F, Real>& run)
{
    const HitStream<F, Real>& hits = run.work.memory->hits;
    for (int first = 0; first < hits.count; first += lanes<Real>)
        run.work.surfaces[first / lanes<Real>] =
            surface_of<F>(run.scene, hits, first, first_lanes<Real>(hits.count - first));
}

/// Computes the shadows of each light at the hits.
template <abi::Features F, class Real>
inline void find_shadows(const TileRun<F, Real>& run, const ShadeContext<F, Real>& context)
{
    for (int light = 0; light < run.scene.lighting.lights.count; ++light)
        if (run.scene.lighting.lights.data[light].casts_shadow &&
            !run.work.occluders[light].are_all)
            find_shadows(context, run.work.memory->hits, light, *run.work.bundle,
                         run.work.shadows[light]);
}

/// Counts a chunk's child rays and joins them in one stream, reflected rays first.
template <abi::Features F, class Real>
inline void join_children(const TileRun<F, Real>& run, RayStream<F, Real>& next, int depth)
{
    run.counts.reflected += static_cast<unsigned>(next.count);
    if (next.count > 0)
        run.counts.passed |= abi::passed_mirrored;
    if constexpr (F.glass) {
        begin_stage(abi::Stage::children, depth, abi::Step::children);
        if constexpr (F.probe)
            next.reflected_count = next.count;
        const RayStream<F, Real>& refracted = *run.work.refracted;
        run.counts.refracted += static_cast<unsigned>(refracted.count);
        if (refracted.count > 0)
            run.counts.passed |= abi::passed_refracted;
        append_stream(next, refracted);
    }
}

/// Shades the hits of a chunk, of rays after `depth` bounces, into the pixels, and collects their
/// child rays in `next`. Returns null, and does not change `next`, if there can be no child rays.
template <abi::Features F, class Real>
inline RayStream<F, Real>* shade_chunk(const TileRun<F, Real>& run, PixelWrite write, int depth,
                                       RayStream<F, Real>* next)
{
    const HitStream<F, Real>& hits = run.work.memory->hits;
    if (hits.count == 0)
        return nullptr;
    record_pixels(hits.pixel);
    run.counts.passed |= abi::passed_normals;
    if constexpr (F.exact)
        run.counts.passed |= abi::passed_refined;
    begin_stage(abi::Stage::shadows, depth, abi::Step::cones);
    const bool by_lists = find_occluders(run);
    const ShadeContext<F, Real> context{&run.scene,
                                        run.work.occluders,
                                        by_lists ? nullptr : run.work.surfaces,
                                        by_lists ? nullptr : run.work.shadows,
                                        depth,
                                        &run.counts,
                                        run.work.lacks};
    if (!by_lists) {
        begin_stage(abi::Stage::shade, depth, abi::Step::surface);
        find_surfaces(run);
        begin_stage(abi::Stage::shadows, depth, abi::Step::cones);
        find_shadows(run, context);
    }
    begin_stage(abi::Stage::shade, depth, abi::Step::surface);
    if (!context.spawns())
        next = nullptr;
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

/// The number of refracted rays in a chunk; they follow the reflected ones.
template <abi::Features F, class Real>
inline int refracted_rays(const RayStream<F, Real>& rays, int begin, int end)
{
    return rays.reflected_count < begin ? end - begin
           : rays.reflected_count < end ? end - rays.reflected_count
                                        : 0;
}

/// Traces the rays `begin` to `end` of a stream, one chunk, and shades their hits as shade_chunk()
/// does.
template <abi::Features F, class Real>
[[gnu::noinline]] RayStream<F, Real>* trace_chunk(const TileRun<F, Real>& run,
                                                  const RayStream<F, Real>& rays, int begin,
                                                  int end, int depth, RayStream<F, Real>* next)
{
    begin_stage(abi::Stage::trace, depth, abi::Step::ray_generation);
    record_pixels(rays.pixel + begin);
    if constexpr (F.probe)
        record_chunk(refracted_rays(rays, begin, end), end - begin);
    const int count = end - begin;
    const Box<Real> box =
        box_of_run<Real>({rays.org[0] + begin, rays.org[1] + begin, rays.org[2] + begin}, count);
    const Cone<Real> cone = cone_nearby<F, Real>(
        box, {rays.dir[0] + begin, rays.dir[1] + begin, rays.dir[2] + begin}, count);
    find_nearby<F>(run.work.nearby, box, cone, run.scene);
    if (picks_all<F>(run.work.nearby, box, cone, run.scene))
        trace_secondary(run.scene, rays, begin, end, run.work.nearby, *run.work.memory, run.counts);
    else
        trace_secondary_bundle(run.scene, rays, begin, end, run.work.nearby, *run.work.bundle,
                               *run.work.memory, run.counts);
    return shade_chunk(run, PixelWrite::add, depth, next);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
