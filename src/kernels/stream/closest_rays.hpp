#pragma once

#include "kernels/precision/refine.hpp"
#include "kernels/stream/ray_chunks.hpp"
#include "kernels/traverse/bvh_closest.hpp"
#include "kernels/traverse/retrace_closest.hpp"

// Closest hits of rays from outside.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Object numbers of the lanes of `active`; the others keep what they have or, where every surface
/// is an object of its own, all.
template <class Real>
inline vint<Real> objects_of(const abi::SceneView<Real>& scene, const vint<Real>& surface,
                             std::uint32_t active)
{
    if (scene.materials.surfaces_are_objects)
        return surface;
    alignas(64) lane_int<Real> number[lanes<Real>];
    store(number, surface);
    for (; active != 0; active &= active - 1) {
        const int lane = __builtin_ctz(active);
        number[lane] = scene.materials.of_surface[number[lane]].object;
    }
    return load(number);
}

/// Hands out t and places of what a packet of rays, of which `live` are left, hit. In a function of
/// its own, as few callers ask for places.
template <abi::Features F, class Real>
[[gnu::noinline]] void store_places(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
                                    const HitPacket<Real>& hit, const StartPacket<Real>& start,
                                    const vreal<Real>& t_max, const abi::HitsView<Real>& hits,
                                    int at, int live)
{
    const auto missed = int_equal(hit.surface, no_surface<Real>());
    const std::uint32_t found = ~bits(missed) & first_lanes<Real>(live);
    const vreal<Real> zero(Real(0));
    const Vec3v<Real> nothing{zero, zero, zero};
    RefinedHits<Real> places{t_max, nothing, nothing};
    Vec3v<Real> offset = nothing;
    if (found != 0) {
        places = refined<F, Refine::place>(scene.shapes, rays, hit, start, found);
        places.t = select(missed, t_max, places.t);
        places.normal = select(missed, nothing, places.normal);
        if (scene.rules.start_error > 0)
            offset = origin_offset<Real>(scene.rules.start_error, places.point, places.normal);
    }
    if (hits.t != nullptr)
        store_some(hits.t + at, places.t, live);
    store_some3(hits.normal, at, places.normal, live);
    store_some3(hits.outer_start, at, places.point + offset, live);
    store_some3(hits.inner_start, at, places.point - offset, live);
    store_some3(hits.point, at, places.point, live);
}

/// Hands out what a packet of rays, of which `live` are left, hit: to `at` and after.
template <abi::Features F, class Real>
inline void store_packet_hits(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
                              const HitPacket<Real>& hit, const StartPacket<Real>& start,
                              const vreal<Real>& t_max, const abi::HitsView<Real>& hits, int at,
                              int live)
{
    const auto missed = int_equal(hit.surface, no_surface<Real>());
    const std::uint32_t found = ~bits(missed) & first_lanes<Real>(live);
    store_numbers<Real>(hits.object + at, objects_of(scene, hit.surface, found), live);
    if (hits.surface != nullptr)
        store_numbers<Real>(hits.surface + at, hit.surface, live);
    if (hits.normal[0] != nullptr)
        return store_places<F>(scene, rays, hit, start, t_max, hits, at, live);
    if (hits.t == nullptr)
        return;
    vreal<Real> t = hit.t;
    if (F.exact && found != 0)
        t = refined<F, Refine::t>(scene.shapes, rays, hit, start, found).t;
    store_some(hits.t + at, select(missed, t_max, t), live);
}

/// The same of hits on one surface.
inline void store_common_hits(const abi::SceneView<float>& scene, const CommonHit& hit,
                              const vreal<float>& t_max, const abi::HitsView<float>& hits, int at,
                              int live)
{
    const vmask<float> found = from_bits<float>(hit.lanes);
    const vint<float> none(lane_int<float>(-1));
    const bool hits_any = hit.lanes != 0;
    const std::int32_t object = hits_any ? scene.materials.of_surface[hit.surface].object : -1;
    store_numbers<float>(hits.object + at, select(found, vint<float>(object), none), live);
    if (hits.surface != nullptr)
        store_numbers<float>(hits.surface + at,
                             select(found, vint<float>(hits_any ? hit.surface : -1), none), live);
    if (hits.t != nullptr)
        store_some(hits.t + at, select(found, hit.t, t_max), live);
    if (hits.normal[0] == nullptr)
        return;
    const vreal<float> zero(0.0f);
    const Vec3v<float> nothing{zero, zero, zero};
    const Vec3v<float> normal = select(found, hit.outward, nothing);
    const Vec3v<float> point = select(found, hit.point, nothing);
    Vec3v<float> offset = nothing;
    if (scene.rules.start_error > 0 && hits_any)
        offset = origin_offset<float>(scene.rules.start_error, point, normal);
    store_some3(hits.normal, at, normal, live);
    store_some3(hits.outer_start, at, point + offset, live);
    store_some3(hits.inner_start, at, point - offset, live);
    store_some3(hits.point, at, point, live);
}

/// Finds and stores the hits of a packet where they are on one surface (common_hit.hpp); false
/// where that can't be told. `eye` is the rays' origin where they share it.
template <Origin O>
inline bool store_if_common(const abi::SceneView<float>& scene, const CommonObjects& common,
                            const StreamPacket<float>& packet, const float (&eye)[3],
                            const abi::HitsView<float>& hits, int at)
{
    const RayPacket<float>& rays = packet.rays;
    const std::uint32_t live = first_lanes<float>(packet.count);
    const std::uint32_t fit = bits(certifiable(rays)) & bits(rays.t_min >= vreal<float>(0.0f));
    CommonHit hit;
    if ((live & ~fit) != 0 || !find_common_hit<O>(hit, common, all_of(common), rays, eye, -1, live))
        return false;
    // What ends before t_max for sure counts.
    if (hit.lanes != 0 &&
        (hit.lanes & ~bits(hit.t * vreal<float>(1.0f + 0x1p-20f) < packet.t_max)) != 0)
        return false;
    store_common_hits(scene, hit, packet.t_max, hits, at, packet.count);
    return true;
}

// What passes over a chunk is a function of its own: in one with the code around it, the compiler
// spills so much that rays took a quarter longer.

/// Where the scene has no hierarchy: packet by packet, without a bundle in between. `Starts` tells
/// whether rays may start on surfaces.
template <bool Starts, abi::Features F, class Objects, class Real>
[[gnu::noinline]] void closest_chunk_in_lists(const abi::SceneView<Real>& scene,
                                              const Objects& objects,
                                              const abi::RaysView<Real>& view, int begin, int end,
                                              const abi::HitsView<Real>& hits)
{
    for (int first = begin; first < end; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, first);
        const std::uint32_t live = first_lanes<Real>(packet.count);
        StartPacket<Real> start = no_start<Real>();
        HitPacket<Real> hit = no_hit<Real>(packet.t_max);
        if constexpr (Starts) {
            start = start_of(scene, view, first, packet.rays);
            hit = start_of_search(start, packet.t_max);
            closest_hit<F>(hit, objects, packet.rays,
                           own_with_common<Real>(start.surface, view.start_surface[first], live));
        } else {
            closest_hit<F>(hit, objects, packet.rays, NoOwn{});
        }
        settle_packet<F>(scene, packet.rays, hit, start, packet.t_max, live);
        store_packet_hits<F>(scene, packet.rays, hit, start, packet.t_max, hits, first,
                             packet.count);
    }
}

/// The same where packets may have a common hit; those that have none, and as many after them as
/// `pause` says, go through the lists.
template <abi::Features F, class Objects>
[[gnu::noinline]] void common_chunk_in_lists(const abi::SceneView<float>& scene,
                                             const Objects& objects, const CommonObjects& common,
                                             CommonPause& pause, const abi::RaysView<float>& view,
                                             int begin, int end, const abi::HitsView<float>& hits)
{
    constexpr Origin origin = Objects::shared ? Origin::shared : Origin::any;
    const float eye[3] = {view.org[0][begin], view.org[1][begin], view.org[2][begin]};
    int first = begin;
    while (first < end) {
        const int listed = first;
        for (; first < end && !pause.is_over(); first += lanes<float>) {
        }
        if (first > listed)
            closest_chunk_in_lists<false, F>(scene, objects, view, listed,
                                             first < end ? first : end, hits);
        for (bool found = true; found && first < end; first += lanes<float>) {
            found = store_if_common<origin>(scene, common, StreamPacket<float>(view, first), eye,
                                            hits, first);
            pause.record(found);
            if (!found)
                closest_chunk_in_lists<false, F>(
                    scene, objects, view, first,
                    first + lanes<float> < end ? first + lanes<float> : end, hits);
        }
    }
}

template <abi::Features F, class Real>
[[gnu::noinline]] void closest_chunk_in_tree(const abi::SceneView<Real>& scene,
                                             const StreamWork<F, Real>& work,
                                             const abi::RaysView<Real>& view, int begin, int end,
                                             const abi::HitsView<Real>& hits)
{
    RayBundle<Real>& bundle = *work.bundle;
    const int count = end - begin;
    const auto start_at = [&](int first) {
        return start_of(scene, view, begin + first, load_rays(bundle, first));
    };
    const auto t_max_at = [&](int first) {
        return load_some(view.t_max + begin + first, count - first);
    };
    for (int first = 0; first < count; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, begin + first);
        const StartPacket<Real> start = start_of(scene, view, begin + first, packet.rays);
        store_rays(bundle, first, packet.rays);
        start_rays<F>(bundle, first, start_of_search(start, packet.t_max), start.surface,
                      first_lanes<Real>(count - first) & numbers(packet));
    }
    end_bundle(bundle, count);
    closest_of_bundle<F>(scene, work.nearby, bundle);
    settle_bundle<F>(scene, bundle, start_at, t_max_at);
    for (int first = 0; first < count; first += lanes<Real>)
        store_packet_hits<F>(scene, load_rays(bundle, first), load_hits(bundle, first),
                             start_at(first), t_max_at(first), hits, begin + first, count - first);
}

/// The closest hits of a chunk of rays that start on no surface, where there is no hierarchy.
template <abi::Features F, class Objects, class Real>
inline void closest_chunk(const abi::SceneView<Real>& scene, StreamWork<F, Real>& work,
                          const Objects& objects, const abi::RaysView<Real>& view, int begin,
                          int end, const abi::HitsView<Real>& hits)
{
    if constexpr (F.exact)
        if (work.common.are_all)
            return common_chunk_in_lists<F>(scene, objects, work.common, work.pause, view, begin,
                                            end, hits);
    closest_chunk_in_lists<false, F>(scene, objects, view, begin, end, hits);
}

template <abi::Features F, class Real>
inline void closest_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                         const abi::HitsView<Real>& hits, void* scratch)
{
    StreamWork<F, Real> work(scratch, scene);
    work.wants_common = scene.tree.empty();
    for_each_chunk(work, scene, view, [&](int begin, int end) {
        if (!scene.tree.empty())
            closest_chunk_in_tree(scene, work, view, begin, end, hits);
        else if (work.shares_origin)
            closest_chunk(scene, work, work.from_point, view, begin, end, hits);
        else if (view.start_surface != nullptr)
            closest_chunk_in_lists<true, F>(scene, work.nearby, view, begin, end, hits);
        else
            closest_chunk(scene, work, work.nearby, view, begin, end, hits);
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
