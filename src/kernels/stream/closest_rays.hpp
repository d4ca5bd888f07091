#pragma once

#include "kernels/bvh/bvh_closest.hpp"
#include "kernels/retrace/retrace_closest.hpp"
#include "kernels/stream/hit_writer.hpp"
#include "kernels/stream/ray_chunks.hpp"

// Closest hits of rays from the caller.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Finds and stores the hits of a packet if they are all on one surface (common_hit.hpp). Returns
/// false if that cannot be decided. `shared_origin` is the rays' origin if they share it.
template <Refine R, Origin O, class Writer>
inline bool store_if_common(Writer& writer, const CommonObjects& common,
                            const StreamPacket<float>& packet, const float (&shared_origin)[3],
                            int at)
{
    const RayPacket<float>& rays = packet.rays;
    const std::uint32_t live = first_lanes<float>(packet.count);
    const std::uint32_t fit = bits(certifiable(rays)) & bits(rays.t_min >= vreal<float>(0.0f));
    CommonHit hit;
    if ((live & ~fit) != 0 ||
        !find_common_hit<R, O>(hit, common, common, rays, shared_origin, -1, live))
        return false;
    // Only hits certainly before t_max count.
    if (hit.lanes != 0 &&
        (hit.lanes & ~bits(hit.t * vreal<float>(1.0f + 0x1p-20f) < packet.t_max)) != 0)
        return false;
    writer.store_hits(hit, packet.t_max, at, packet.count);
    return true;
}

/// Whether rays of a caller may start on surfaces.
enum class RayStarts { anywhere, on_surfaces };

// Each loop over a chunk is a function of its own: inlined into other code, the compiler spills so
// many registers that rays took a quarter longer.

/// For scenes without a BVH: packet by packet, without a bundle. `Starts`: rays may start on
/// surfaces.
template <RayStarts S, abi::Features F, class Objects, class Real>
[[gnu::noinline]] void closest_chunk_in_lists(const abi::SceneView<Real>& scene,
                                              const Objects& objects,
                                              const abi::RaysView<Real>& view, int begin, int end,
                                              HitWriter<F, Real>& writer)
{
    for (int first = begin; first < end; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, first);
        const std::uint32_t live = first_lanes<Real>(packet.count);
        StartPacket<Real> start = no_start<Real>();
        HitPacket<Real> hit = no_hit<Real>(packet.t_max);
        if constexpr (S == RayStarts::on_surfaces) {
            start = start_of(scene, view, first, packet.rays);
            hit = start_of_search<F>(start, packet.rays.dir2, packet.t_max);
            closest_hit<F>(hit, objects, packet.rays,
                           own_with_common<Real>(start.surface, view.start_surface[first], live));
        } else {
            closest_hit<F>(hit, objects, packet.rays, NoOwn{});
        }
        correct_packet<F>(scene, packet.rays, hit, start, packet.t_max, live);
        writer.store_hits(packet.rays, hit, start, packet.t_max, first, packet.count);
    }
}

/// The same if packets may have a common hit. Packets without one, and after each as many as
/// `pause` says, go through the lists.
template <Refine R, abi::Features F, class Objects>
[[gnu::noinline]] void common_chunk_in_lists(const abi::SceneView<float>& scene,
                                             const Objects& objects, const CommonObjects& common,
                                             TryPause& pause, const abi::RaysView<float>& view,
                                             int begin, int end, HitWriter<F, float>& writer)
{
    constexpr Origin origin = Objects::origin;
    const float shared_origin[3] = {view.org[0][begin], view.org[1][begin], view.org[2][begin]};
    int first = begin;
    while (first < end) {
        const int listed = first;
        for (; first < end && !pause.is_over(); first += lanes<float>) {
        }
        if (first > listed)
            closest_chunk_in_lists<RayStarts::anywhere, F>(scene, objects, view, listed,
                                                           first < end ? first : end, writer);
        for (bool found = true; found && first < end; first += lanes<float>) {
            found = store_if_common<R, origin>(writer, common, StreamPacket<float>(view, first),
                                               shared_origin, first);
            if (found) {
                pause.record_success();
                continue;
            }
            pause.record_failure();
            closest_chunk_in_lists<RayStarts::anywhere, F>(
                scene, objects, view, first,
                first + lanes<float> < end ? first + lanes<float> : end, writer);
        }
    }
}

/// Fills a bundle with `count` rays from `begin` on.
template <RayStarts S, abi::Features F, class Real>
[[gnu::noinline]] void fill_bundle(RayBundle<Real>& bundle, const abi::SceneView<Real>& scene,
                                   const abi::RaysView<Real>& view, int begin, int count)
{
    for (int first = 0; first < count; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, begin + first);
        const std::uint32_t active = first_lanes<Real>(count - first) & numbers(packet);
        store_rays(bundle, first, packet.rays);
        if constexpr (S == RayStarts::on_surfaces) {
            const StartPacket<Real> start = start_of(scene, view, begin + first, packet.rays);
            start_rays<F>(bundle, first, start_of_search<F>(start, packet.rays.dir2, packet.t_max),
                          start.surface, active);
        } else {
            start_rays<F>(bundle, first, no_hit<Real>(packet.t_max), no_surface<Real>(), active);
        }
    }
    end_bundle(bundle, count);
}

template <abi::Features F, class Real>
[[gnu::noinline]] void closest_chunk_in_bvh(const abi::SceneView<Real>& scene,
                                            const StreamWork<F, Real>& work,
                                            const abi::RaysView<Real>& view, int begin, int end,
                                            HitWriter<F, Real>& writer)
{
    RayBundle<Real>& bundle = *work.bundle;
    const int count = end - begin;
    const auto start_with = [&](int first, const RayPacket<Real>& rays) {
        return start_of(scene, view, begin + first, rays);
    };
    const auto start_at = [&](int first) { return start_with(first, load_rays(bundle, first)); };
    const auto t_max_at = [&](int first) {
        return load_some(view.t_max + begin + first, count - first);
    };
    if (view.start_surface == nullptr)
        fill_bundle<RayStarts::anywhere, F>(bundle, scene, view, begin, count);
    else
        fill_bundle<RayStarts::on_surfaces, F>(bundle, scene, view, begin, count);
    closest_of_bundle<F>(scene, work.nearby, bundle);
    correct_bundle<F>(scene, bundle, start_at, t_max_at);
    for (int first = 0; first < count; first += lanes<Real>) {
        const RayPacket<Real> rays = load_rays(bundle, first);
        writer.store_hits(rays, load_hits(bundle, first), start_with(first, rays), t_max_at(first),
                          begin + first, count - first);
    }
}

/// The closest hits of a chunk of rays that start on no surface, without a BVH.
template <abi::Features F, class Objects, class Real>
inline void closest_chunk(const abi::SceneView<Real>& scene, StreamWork<F, Real>& work,
                          const Objects& objects, const abi::RaysView<Real>& view, int begin,
                          int end, HitWriter<F, Real>& writer)
{
    if constexpr (F.exact)
        if (work.common.are_all) {
            const auto chunk = writer.asks_for_places()
                                   ? common_chunk_in_lists<Refine::place, F, Objects>
                                   : common_chunk_in_lists<Refine::t, F, Objects>;
            return chunk(scene, objects, work.common, work.pause, view, begin, end, writer);
        }
    closest_chunk_in_lists<RayStarts::anywhere, F>(scene, objects, view, begin, end, writer);
}

template <abi::Features F, class Real>
inline void closest_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                         const abi::HitsView<Real>& hits, void* scratch)
{
    StreamWork<F, Real> work(scratch, scene);
    work.wants_common = scene.tree.empty();
    HitWriter<F, Real> writer(scene, hits);
    for_each_chunk(work, scene, view, [&](int begin, int end) {
        if (!work.by_lists)
            closest_chunk_in_bvh(scene, work, view, begin, end, writer);
        else if (work.shares_origin)
            closest_chunk(scene, work, work.from_point, view, begin, end, writer);
        else if (view.start_surface != nullptr)
            closest_chunk_in_lists<RayStarts::on_surfaces, F>(scene, work.nearby, view, begin, end,
                                                              writer);
        else
            closest_chunk(scene, work, work.nearby, view, begin, end, writer);
    });
    writer.finish();
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
