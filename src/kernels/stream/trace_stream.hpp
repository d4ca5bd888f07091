#pragma once

#include "kernels/lists/object_sets.hpp"
#include "kernels/precision/refine.hpp"
#include "kernels/retrace/retrace_closest.hpp"
#include "kernels/stream/camera_rays.hpp"
#include "kernels/stream/shade_stream.hpp"

#include <limits>

// Traces rays to their hits, one generation at a time.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A packet of rays, with all values that their hits inherit.
template <class Real>
struct TracedRays {
    RayPacket<Real> rays;
    PathPacket<Real> path;
    GlassPacket<Real> inside;
    StartPacket<Real> start;
};

/// Lanes whose rays leave the object that they start in at the start point, as where they only
/// touch it.
template <class Real>
inline std::uint32_t leaves_at_once(const StartPacket<Real>& start, const HitPacket<Real>& hit)
{
    const auto at_once = start.second.t <= vreal<Real>(std::numeric_limits<Real>::min());
    return bits(at_once) & bits(int_equal(hit.surface, start.second.surface));
}

/// Outward normals, but the ray's direction for rays that leave at once although the normal says
/// that they enter: in a cone's apex, or along the surface. Such a ray would otherwise enter again
/// and again.
template <class Real>
inline Vec3v<Real> leaving_normals(const abi::SceneView<Real>& scene, const Vec3v<Real>& normal,
                                   const RayPacket<Real>& rays, std::uint32_t leaves)
{
    const auto along = dot(normal, rays.dir) > grazing(scene, normal, rays.dir);
    const std::uint32_t turned = leaves & ~bits(along);
    return select(from_bits<Real>(turned),
                  scale<Real>(vreal<Real>(Real(1)) / sqrt(rays.dir2), rays.dir), normal);
}

/// Appends points, normals and directions of hits, as far as shading needs them.
template <abi::Features F, class Real>
[[gnu::noinline]] void append_places(const abi::SceneView<Real>& scene, HitStream<F, Real>& hits,
                                     const TracedRays<Real>& from, const HitPacket<Real>& hit,
                                     std::uint32_t active)
{
    if (!F.probe && scene.lighting.flat && scene.materials.checkers == nullptr)
        return;
    RefinedHits<Real> places =
        refined<F, Refine::place>(scene.shapes, from.rays, hit, from.start, active);
    if constexpr (F.glass) {
        const std::uint32_t leaves = leaves_at_once(from.start, hit) & active;
        if (leaves != 0)
            places.normal = leaving_normals(scene, places.normal, from.rays, leaves);
    }
    with_appender<Real>(active, [&](const auto& chosen) {
        append3(hits.point, hits.count, chosen, places.point);
        append3(hits.normal, hits.count, chosen, places.normal);
        append3(hits.dir, hits.count, chosen, from.rays.dir);
    });
}

template <abi::Features F, class Real>
inline void append_hits(const abi::SceneView<Real>& scene, HitStream<F, Real>& hits,
                        const TracedRays<Real>& from, const HitPacket<Real>& hit,
                        std::uint32_t active)
{
    if (active == 0)
        return;
    const StepScope step(abi::Step::compaction);
    append_places(scene, hits, from, hit, active);
    with_appender<Real>(active, [&](const auto& chosen) {
        append_weight(hits, chosen, from.path.weight);
        chosen.append(hits.pixel + hits.count, from.path.pixel);
        chosen.append(hits.surface + hits.count, hit.surface);
        append_glass(hits, chosen, from.inside);
        if constexpr (F.probe)
            chosen.append(hits.path + hits.count, from.path.id);
    });
    hits.count += __builtin_popcount(active);
}

template <class Real>
inline std::uint32_t hit_lanes(const HitPacket<Real>& hit)
{
    return ~bits(int_equal(hit.surface, vint<Real>(lane_int<Real>(-1)))) & all_lanes<Real>;
}

/// The glass that the camera is in; not set without Features::glass.
template <abi::Features F, class Real>
inline GlassPacket<Real> glass_around_camera(const abi::CameraView<Real>& camera)
{
    GlassPacket<Real> glass;
    for (int i = 0; F.glass && i < abi::glass_depth; ++i)
        glass.body[i] = vint<Real>(static_cast<lane_int<Real>>(camera.inside[i]));
    return glass;
}

/// The light that rays which hit nothing return: the background, or the lights that they run
/// straight towards.
template <class Real>
inline Vec3v<Real> escaped(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays)
{
    const Vec3v<Real> background = broadcast(scene.rules.background);
    if (scene.lighting.seen_within == 0)
        return background;
    const vreal<Real> zero(Real(0));
    const vreal<Real> parallel(scene.lighting.seen_within * scene.lighting.seen_within);
    Vec3v<Real> seen{zero, zero, zero};
    std::uint32_t any_seen = 0;
    for (int i = 0; i < scene.lighting.lights.count; ++i) {
        const abi::LightRecord<Real>& light = scene.lighting.lights.data[i];
        Vec3v<Real> way = broadcast(light.vector);
        if (light.kind == abi::LightKind::point)
            way = way - rays.org;
        const Vec3v<Real> sine = cross(rays.dir, way);
        const auto sees =
            (dot(rays.dir, way) > zero) & (dot(sine, sine) <= parallel * rays.dir2 * dot(way, way));
        seen = select(sees, seen + broadcast(light.intensity), seen);
        any_seen |= bits(sees);
    }
    return select(from_bits<Real>(any_seen), seen, background);
}

template <abi::Features F, class Real>
inline void report_rays(const HitStream<F, Real>& hits, const abi::SceneView<Real>& scene,
                        const TracedRays<Real>& from, const HitPacket<Real>& hit,
                        std::uint32_t active)
{
    if constexpr (F.probe) {
        if (hits.probe == nullptr)
            return;
        HitPacket<Real> reported = hit;
        const std::uint32_t found = hit_lanes(hit) & active;
        if (found != 0)
            reported.t = select(
                from_bits<Real>(found),
                refined<F, Refine::t>(scene.shapes, from.rays, hit, from.start, found).t, hit.t);
        packet_probe(hits, from.path, active)
            .ray(scene, from.rays, reported, escaped(scene, from.rays));
    }
}

/// Appends the hits of a packet of camera rays; the pixels hold the background already.
template <abi::Features F, class Real>
inline void take_camera_hits(const abi::SceneView<Real>& scene, TileMemory<F, Real>& memory,
                             const TracedRays<Real>& from, const HitPacket<Real>& hit,
                             std::uint32_t pixels)
{
    const std::uint32_t hits = hit_lanes(hit) & pixels;
    count_traced<Real>(pixels, hit.surface, from.path.pixel);
    append_hits(scene, memory.hits, from, hit, hits);
    report_rays(memory.hits, scene, from, hit, pixels);
    const StepScope step(abi::Step::film);
    if (scene.lighting.seen_within > 0)
        write_colors(PixelWrite::set, memory.color, from.path.pixel, escaped(scene, from.rays),
                     pixels & ~hits);
}

/// The paths of the pixels from number `first` on.
template <class Real>
inline PathPacket<Real> camera_path(int first)
{
    const vreal<Real> one(Real(1));
    return {
        {one, one, one}, lane_numbers<Real>(first), vint<Real>(lane_int<Real>{abi::camera_path})};
}

/// Traces the camera rays of a tile, whose pixels are numbered from `first_pixel` on.
template <abi::Features F, class Real>
inline void trace_camera(const abi::TileJob<Real>& job, int first_pixel,
                         const FromPoint<F, Real>& visible, TileMemory<F, Real>& memory,
                         abi::RayCounts& counts)
{
    const vreal<Real> no_end_yet(static_cast<Real>(__builtin_inf()));
    const TileCamera<Real> camera(job);
    const GlassPacket<Real> inside = glass_around_camera<F>(camera.view);
    for (int first = 0; first < abi::tile_pixels; first += lanes<Real>) {
        const std::uint32_t pixels = lanes_inside(job, first);
        if (pixels == 0)
            continue;
        const RayPacket<Real> rays = camera_rays(camera, first, job.scene->rules.units);
        HitPacket<Real> hit = no_hit<Real>(static_cast<Real>(__builtin_inf()));
        record_live(pixels);
        record_first(first);
        closest_hit<F>(hit, visible, rays, NoOwn{});
        count_unsure(
            counts, correct_packet<F>(*job.scene, rays, hit, no_start<Real>(), no_end_yet, pixels));
        take_camera_hits(*job.scene, memory,
                         {rays, camera_path<Real>(first_pixel + first), inside, no_start<Real>()},
                         hit, pixels);
    }
}

/// Fills a bundle with the camera rays of a tile.
template <abi::Features F, class Real>
inline void gather_camera(const abi::TileJob<Real>& job, RayBundle<Real>& bundle)
{
    const TileCamera<Real> camera(job);
    const HitPacket<Real> none = no_hit<Real>(static_cast<Real>(__builtin_inf()));
    for (int first = 0; first < bundle_rays; first += lanes<Real>) {
        store_rays(bundle, first, camera_rays(camera, first, job.scene->rules.units));
        start_rays<F>(bundle, first, none, no_surface<Real>(), lanes_inside(job, first));
    }
}

template <abi::Features F, class Real>
inline int correct_camera_bundle(const abi::SceneView<Real>& scene, RayBundle<Real>& bundle)
{
    return correct_bundle<F>(
        scene, bundle, [](int) { return no_start<Real>(); },
        [](int) { return vreal<Real>(static_cast<Real>(__builtin_inf())); });
}

/// The same with a BVH.
template <abi::Features F, class Real>
inline void trace_camera_bundle(const abi::TileJob<Real>& job, int first_pixel,
                                const FromPoint<F, Real>& visible, RayBundle<Real>& bundle,
                                TileMemory<F, Real>& memory, abi::RayCounts& counts)
{
    gather_camera<F>(job, bundle);
    closest_of_bundle<F>(*job.scene, visible, bundle);
    counts.unsure += static_cast<unsigned>(correct_camera_bundle<F>(*job.scene, bundle));
    const GlassPacket<Real> inside = glass_around_camera<F>(*job.camera);
    for (int first = 0; first < bundle_rays; first += lanes<Real>) {
        const std::uint32_t pixels = active_lanes(bundle, first);
        if (pixels != 0)
            take_camera_hits(*job.scene, memory,
                             {load_rays(bundle, first), camera_path<Real>(first_pixel + first),
                              inside, no_start<Real>()},
                             load_hits(bundle, first), pixels);
    }
}

template <abi::Features F, class Real>
inline TracedRays<Real> load_stream(const abi::SceneView<Real>& scene,
                                    const RayStream<F, Real>& stream, int first)
{
    return {make_rays<Real>(load3(stream.org, first), load3(stream.dir, first),
                            scene.rules.secondary_t_min),
            {load_weight(stream, first), load(stream.pixel + first), load_path(stream, first)},
            load_glass(stream, first),
            load_start(stream, first)};
}

/// Appends the hits of a packet of secondary rays; adds the light of those that miss to the pixels.
template <abi::Features F, class Real>
inline void take_secondary_hits(const abi::SceneView<Real>& scene, TileMemory<F, Real>& memory,
                                const TracedRays<Real>& from, const HitPacket<Real>& hit,
                                std::uint32_t active)
{
    const std::uint32_t hits = hit_lanes(hit) & active;
    count_traced<Real>(active, hit.surface, from.path.pixel);
    append_hits(scene, memory.hits, from, hit, hits);
    report_rays(memory.hits, scene, from, hit, active);
    const StepScope step(abi::Step::film);
    write_colors(PixelWrite::add, memory.color, from.path.pixel,
                 from.path.weight * escaped(scene, from.rays), active & ~hits);
}

/// Traces a chunk of a stream of secondary rays.
template <abi::Features F, class Real>
inline void trace_secondary(const abi::SceneView<Real>& scene, const RayStream<F, Real>& stream,
                            int begin, int end, const FromAnywhere<F, Real>& nearby,
                            TileMemory<F, Real>& memory, abi::RayCounts& counts)
{
    memory.hits.count = 0;
    const vreal<Real> no_end_yet(static_cast<Real>(__builtin_inf()));
    for (int first = begin; first < end; first += lanes<Real>) {
        const TracedRays<Real> from = load_stream(scene, stream, first);
        const std::uint32_t active = first_lanes<Real>(end - first);
        HitPacket<Real> hit = start_of_search<F>(from.start, from.rays.dir2, no_end_yet);
        record_live(active);
        record_first(first - begin);
        if (stream.starts != nullptr)
            closest_hit<F>(
                hit, nearby, from.rays,
                own_with_common<Real>(from.start.surface, stream.starts->surface[first], active));
        else
            closest_hit<F>(hit, nearby, from.rays, NoOwn{});
        count_unsure(counts,
                     correct_packet<F>(scene, from.rays, hit, from.start, no_end_yet, active));
        take_secondary_hits(scene, memory, from, hit, active);
    }
}

/// The same with a BVH.
template <abi::Features F, class Real>
inline void trace_secondary_bundle(const abi::SceneView<Real>& scene,
                                   const RayStream<F, Real>& stream, int begin, int end,
                                   const FromAnywhere<F, Real>& nearby, RayBundle<Real>& bundle,
                                   TileMemory<F, Real>& memory, abi::RayCounts& counts)
{
    memory.hits.count = 0;
    const vreal<Real> no_end_yet(static_cast<Real>(__builtin_inf()));
    for (int first = begin; first < end; first += lanes<Real>) {
        const TracedRays<Real> from = load_stream(scene, stream, first);
        store_rays(bundle, first - begin, from.rays);
        start_rays<F>(bundle, first - begin,
                      start_of_search<F>(from.start, from.rays.dir2, no_end_yet),
                      from.start.surface, first_lanes<Real>(end - first));
    }
    end_bundle(bundle, end - begin);
    closest_of_bundle<F>(scene, nearby, bundle);
    counts.unsure += static_cast<unsigned>(correct_bundle<F>(
        scene, bundle, [&](int first) { return load_start(stream, begin + first); },
        [&](int) { return no_end_yet; }));
    for (int first = begin; first < end; first += lanes<Real>)
        take_secondary_hits(scene, memory, load_stream(scene, stream, first),
                            load_hits(bundle, first - begin), first_lanes<Real>(end - first));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
