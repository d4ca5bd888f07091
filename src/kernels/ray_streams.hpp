#pragma once

#include "kernel_abi/ray_streams.hpp"
#include "kernels/finish.hpp"
#include "kernels/group_closest.hpp"
#include "kernels/second_meeting.hpp"
#include "kernels/settle_start.hpp"
#include "kernels/stream_values.hpp"
#include "kernels/surface.hpp"
#include "kernels/tree_blockers.hpp"
#include "kernels/tree_crossings.hpp"

// Streams of rays from outside: closest hits, occlusion, all hits.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct StreamPacket {
    RayPacket<Real> rays;
    vreal<Real> t_max;
    int count;  ///< rays from here on, perhaps more than a packet

    StreamPacket(const abi::RaysView<Real>& view, int first) : count(view.count - first)
    {
        rays.org = load_some3(view.org, first, count);
        rays.dir = load_some3(view.dir, first, count);
        rays.dir2 = dot(rays.dir, rays.dir);
        rays.t_min = load_some(view.t_min + first, count);
        t_max = load_some(view.t_max + first, count);
    }
};

/// Object numbers of the lanes of `active`; the others keep what they have or, where every surface
/// is an object of its own, all.
template <class Real>
inline vint<Real> objects_of(const abi::SceneView<Real>& scene, const vint<Real>& surface,
                             std::uint32_t active)
{
    if (scene.surfaces_are_objects)
        return surface;
    alignas(64) lane_int<Real> number[lanes<Real>];
    store(number, surface);
    for (; active != 0; active &= active - 1) {
        const int lane = __builtin_ctz(active);
        number[lane] = scene.material_index[number[lane]].object;
    }
    return load(number);
}

/// Outward unit normals and object numbers of the lanes of `active`, whose `t` may become more
/// exact.
template <abi::Features F, class Real>
inline SurfacePacket<Real> outward_surface(const abi::SceneView<Real>& scene,
                                           const RayPacket<Real>& rays, vreal<Real>& t,
                                           const vint<Real>& surface, std::uint32_t active)
{
    const FinishedHits<Real> exact = finished<F>(scene, rays, t, surface, active);
    SurfacePacket<Real> result = surface_at<F>(scene, exact.point, rays.dir, surface, active,
                                               scene.finish != nullptr ? &exact.gradient : nullptr);
    t = exact.t;
    // Undo the turn towards the viewer: outward normals of leaving rays go along with them.
    const vreal<Real> zero(Real(0));
    const std::uint32_t against = bits(dot(result.normal, rays.dir) < zero);
    const auto turned = from_bits<Real>(result.leaving & against);
    result.normal =
        select(turned, scale<Real>(vreal<Real>(Real(-1)), result.normal), result.normal);
    return result;
}

/// Lanes in which nothing is NaN.
template <class Real>
inline std::uint32_t numbers(const StreamPacket<Real>& packet)
{
    const RayPacket<Real>& rays = packet.rays;
    const auto is_number = [](const vreal<Real>& x) { return bits(x == x); };
    return is_number(rays.org.x) & is_number(rays.org.y) & is_number(rays.org.z) &
           is_number(rays.dir.x) & is_number(rays.dir.y) & is_number(rays.dir.z) &
           is_number(rays.t_min) & is_number(packet.t_max);
}

/// Fills a group with the rays of a stream from `begin`, and returns their number.
template <class Real>
inline int gather_stream(const abi::RaysView<Real>& view, int begin, RayGroup<Real>& group)
{
    const int count = view.count - begin < group_rays ? view.count - begin : group_rays;
    for (int first = 0; first < count; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, begin + first);
        store_rays(group, first, packet.rays);
        start_rays(group, first, packet.t_max, first_lanes<Real>(count - first) & numbers(packet));
    }
    end_group(group, count);
    return count;
}

/// The same for packets in which no ray may have hit anything; normals of misses are 0.
template <abi::Features F, class Real>
inline SurfacePacket<Real> surface_or_none(const abi::SceneView<Real>& scene,
                                           const RayPacket<Real>& rays, vreal<Real>& t,
                                           const vint<Real>& surface, std::uint32_t found)
{
    const vreal<Real> zero(Real(0));
    const Vec3v<Real> none{zero, zero, zero};
    SurfacePacket<Real> result;
    result.point = result.normal = result.lift = none;
    result.object = surface;
    if (found == 0)
        return result;
    result = outward_surface<F>(scene, rays, t, surface, found);
    result.normal = select(from_bits<Real>(found), result.normal, none);
    return result;
}

/// Hands out what a packet of rays, of which `live` are left, hit: to `at` and after.
template <abi::Features F, class Real>
inline void store_packet_hits(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
                              const HitPacket<Real>& hit, const vreal<Real>& t_max,
                              const abi::HitsView<Real>& hits, int at, int live)
{
    const auto missed = int_equal(hit.surface, vint<Real>(lane_int<Real>(-1)));
    const std::uint32_t found = ~bits(missed) & first_lanes<Real>(live);
    if (hits.normal[0] == nullptr && scene.finish == nullptr && !scene.sharpened_t) {
        store_some(hits.t + at, select(missed, t_max, hit.t), live);
        store_numbers<Real>(hits.object + at, objects_of(scene, hit.surface, found), live);
        return;
    }
    vreal<Real> t = hit.t;
    const SurfacePacket<Real> surface = surface_or_none<F>(scene, rays, t, hit.surface, found);
    store_some(hits.t + at, select(missed, t_max, t), live);
    store_numbers<Real>(hits.object + at, select(missed, hit.surface, surface.object), live);
    store_some3(hits.normal, at, surface.normal, live);
    store_some3(hits.outer_start, at, surface.point + surface.lift, live);
    store_some3(hits.inner_start, at, surface.point - surface.lift, live);
    store_some3(hits.point, at, surface.point, live);
    if (hits.surface != nullptr)
        store_numbers<Real>(hits.surface + at, hit.surface, live);
}

/// Puts right what a packet of a stream hit, if it is told where its rays start.
template <abi::Features F, class Real>
inline void settle_starts(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                          int first, RayPacket<Real>& rays, HitPacket<Real>& hit)
{
    if (view.start_surface == nullptr || !(scene.start_error > 0))
        return;
    const int count = view.count - first;
    const vint<Real> code = load_numbers<Real>(view.start_surface + first, count);
    const vint<Real> zero(lane_int<Real>(0));
    const vint<Real> none(lane_int<Real>(-1));
    const auto inner = int_less(code, zero);
    const auto elsewhere = int_equal(code, vint<Real>(lane_int<Real>{abi::no_start}));
    const vint<Real> number = select(elsewhere, none, select(inner, none - code, code));
    const std::uint32_t active = first_lanes<Real>(count) & ~bits(elsewhere);
    StartPacket<Real> start{load_some3(view.start_point, first, count), number, hit.t};
    start.second = second_meeting<Real>(scene, number, start.point, rays.dir, ~bits(inner), active);
    settle_start<F>(scene, rays, hit, start, load_some(view.t_max + first, count), active);
}

/// Where the scene has no hierarchy: packet by packet, without a group in between.
template <abi::Features F, class Real>
inline void closest_hits_in_lists(const abi::SceneView<Real>& scene,
                                  const abi::RaysView<Real>& view, const abi::HitsView<Real>& hits)
{
    for (int first = 0; first < view.count; first += lanes<Real>) {
        StreamPacket<Real> packet(view, first);
        HitPacket<Real> hit{packet.t_max, vint<Real>(lane_int<Real>(-1))};
        closest_hit<F>(hit, scene, packet.rays);
        settle_starts<F>(scene, view, first, packet.rays, hit);
        store_packet_hits<F>(scene, packet.rays, hit, packet.t_max, hits, first, packet.count);
    }
}

template <abi::Features F, class Real>
inline void closest_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                         const abi::HitsView<Real>& hits)
{
    if (scene.tree.empty())
        return closest_hits_in_lists<F>(scene, view, hits);
    RayGroup<Real> group;
    for (int begin = 0; begin < view.count; begin += group_rays) {
        const int count = gather_stream(view, begin, group);
        closest_of_group<F>(scene, scene, group);
        for (int first = 0; first < count; first += lanes<Real>) {
            RayPacket<Real> rays = load_rays(group, first);
            HitPacket<Real> hit = load_hits(group, first);
            settle_starts<F>(scene, view, begin + first, rays, hit);
            store_packet_hits<F>(scene, rays, hit,
                                 load_some(view.t_max + begin + first, count - first), hits,
                                 begin + first, count - first);
        }
    }
}

template <abi::Features F, class Real>
inline void occluded_in_lists(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                              std::uint8_t* mask)
{
    for (int first = 0; first < view.count; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, first);
        const std::uint32_t wanted = first_lanes<Real>(packet.count);
        store_mask<Real>(mask + first,
                         occluded<F>(Reach<Real>{packet.t_max, false}, scene, packet.rays,
                                     no_surface<Real>(), wanted),
                         packet.count);
    }
}

template <abi::Features F, class Real>
inline void occluded_rays(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                          std::uint8_t* mask)
{
    if (scene.tree.empty())
        return occluded_in_lists<F>(scene, view, mask);
    RayGroup<Real> group;
    for (int begin = 0; begin < view.count; begin += group_rays) {
        const int count = gather_stream(view, begin, group);
        std::uint16_t wanted[group_cells];
        for (int cell = 0; cell < group_cells; ++cell)
            wanted[cell] = group.active[cell];
        visit_blockers_of_group<F>(scene, scene, group, false, EndsRays{});
        for (int first = 0; first < count; first += lanes<Real>) {
            const std::uint32_t before = wanted[first / cell_rays] >> first % cell_rays;
            store_mask<Real>(mask + begin + first, before & ~active_lanes(group, first),
                             count - first);
        }
    }
}

/// Hands the crossings of one surface to the sink.
template <abi::Features F, class Real>
inline void report_hits(const abi::SceneView<Real>& scene, const RayGroup<Real>& group, int begin,
                        int first, const abi::HitSink<Real>& sink, vmask<Real> valid,
                        const vreal<Real>& t, std::int32_t surface)
{
    const RayPacket<Real> rays = load_rays(group, first);
    std::uint32_t active =
        bits(valid & (t > rays.t_min) & (t < load(group.t + first))) & active_lanes(group, first);
    if (active == 0)
        return;
    vreal<Real> exact_t = t;
    const SurfacePacket<Real> at = outward_surface<F>(
        scene, rays, exact_t, vint<Real>(static_cast<lane_int<Real>>(surface)), active);
    alignas(64) Real ts[lanes<Real>];
    alignas(64) Real normals[3][lanes<Real>];
    store(ts, exact_t);
    store(normals[0], at.normal.x);
    store(normals[1], at.normal.y);
    store(normals[2], at.normal.z);
    const std::int32_t object = scene.material_index[surface].object;
    for (; active != 0; active &= active - 1) {
        const int lane = __builtin_ctz(active);
        const Real normal[3] = {normals[0][lane], normals[1][lane], normals[2][lane]};
        sink.take(sink.context, begin + first + lane, ts[lane], object, normal);
    }
}

template <abi::Features F, class Real>
inline void all_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                     const abi::HitSink<Real>& sink)
{
    RayGroup<Real> group;
    for (int begin = 0; begin < view.count; begin += group_rays) {
        gather_stream(view, begin, group);
        const auto report = [&](int first, vmask<Real> valid, const vreal<Real>& t,
                                std::int32_t surface) {
            report_hits<F>(scene, group, begin, first, sink, valid, t, surface);
        };
        for (int first = 0; first < group_rays; first += lanes<Real>)
            if (active_lanes(group, first) != 0)
                visit_all_crossings<F>(
                    scene, load_rays(group, first),
                    [&](vmask<Real> valid, const vreal<Real>& t, std::int32_t surface) {
                        report(first, valid, t, surface);
                    });
        if (!scene.tree.empty())
            visit_crossings_in_tree<F>(scene.tree, group, report);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
