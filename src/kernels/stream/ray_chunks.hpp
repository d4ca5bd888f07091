#pragma once

#include "kernel_abi/ray_streams.hpp"
#include "kernels/bvh/pick_spheres.hpp"
#include "kernels/lists/common_hit.hpp"
#include "kernels/lists/object_sets.hpp"
#include "kernels/precision/leave_surface.hpp"
#include "kernels/simd/stream_values.hpp"
#include "kernels/stream/workspace.hpp"

// Rays from the caller, in chunks. For each chunk the objects are prepared.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct StreamPacket {
    RayPacket<Real> rays;
    vreal<Real> t_max;
    int count;  ///< number of rays from here on; may be more than a packet

    StreamPacket(const abi::RaysView<Real>& view, int first) : count(view.count - first)
    {
        rays.org = load_some3(view.org, first, count);
        rays.dir = load_some3(view.dir, first, count);
        rays.dir2 = dot(rays.dir, rays.dir);
        rays.t_min = load_some(view.t_min + first, count);
        t_max = load_some(view.t_max + first, count);
    }
};

/// Lanes in which no value is NaN.
template <class Real>
inline std::uint32_t numbers(const StreamPacket<Real>& packet)
{
    const RayPacket<Real>& rays = packet.rays;
    const auto is_number = [](const vreal<Real>& x) { return bits(x == x); };
    return is_number(rays.org.x) & is_number(rays.org.y) & is_number(rays.org.z) &
           is_number(rays.dir.x) & is_number(rays.dir.y) & is_number(rays.dir.z) &
           is_number(rays.t_min) & is_number(packet.t_max);
}

/// Where the rays of a packet start, if the caller says so.
template <class Real>
inline StartPacket<Real> start_of(const abi::SceneView<Real>& scene,
                                  const abi::RaysView<Real>& view, int first,
                                  const RayPacket<Real>& rays)
{
    if (view.start_surface == nullptr || !(scene.rules.start_error > 0))
        return no_start<Real>();
    const int count = view.count - first;
    const vint<Real> none(lane_int<Real>(-1));
    const vint<Real> code = load_numbers<Real>(view.start_surface + first, count);
    const auto inner = int_less(code, vint<Real>(lane_int<Real>(0)));
    const auto elsewhere = int_equal(code, vint<Real>(lane_int<Real>{abi::no_start}));
    const vint<Real> number = select(elsewhere, none, select(inner, none - code, code));
    const std::uint32_t active = first_lanes<Real>(count) & ~bits(elsewhere);
    const Vec3v<Real> point = load_some3(view.start_point, first, count);
    return {
        point, number,
        second_hit<Real>(scene.shapes, number, point, rays.dir, rays.t_min, ~bits(inner), active)};
}

/// Decides how many tries to skip after failed ones: after each packet without a common hit more
/// packets are not tried, so that rays without common hits cost almost nothing. The same for chunks
/// for which nothing could be picked.
struct TryPause {
    static constexpr int longest = 256;
    int length = 1;
    int left = 0;

    /// Whether the next packet is to be tried.
    bool is_over()
    {
        if (left == 0)
            return true;
        --left;
        return false;
    }
    void record_success()
    {
        left = 0;
        length = 1;
    }
    void record_failure()
    {
        left = length - 1;
        length = length < longest ? 2 * length : longest;
    }
};

/// Whether the rays of a packet run in similar directions: within 25 degrees of the first.
template <class Real>
inline bool run_together(const abi::RaysView<Real>& view, int begin)
{
    const Vec3v<Real> dir = load_some3(view.dir, begin, view.count - begin);
    const Real first[3] = {view.dir[0][begin], view.dir[1][begin], view.dir[2][begin]};
    const Vec3v<Real> axis = broadcast(first);
    const vreal<Real> along = dot(dir, axis);
    return all(along * abs(along) > vreal<Real>(Real(0.82)) * dot(dir, dir) * dot(axis, axis));
}

/// The lists prepared for one call.
template <abi::Features F, class Real>
struct StreamWork {
    FromAnywhere<F, Real> nearby;
    FromPoint<F, Real> from_point;  ///< used instead of `nearby` for rays from one point
    bool shares_origin = false;     ///< the chunk's rays start at one point
    bool by_lists = false;          ///< the chunk's rays can hit no object outside the lists
    TryPause picking;               ///< skips chunks after failed tries to pick
    CommonObjects common;           ///< in exact mode without a BVH
    bool wants_common = false;      ///< closest hits are wanted, without a BVH
    TryPause pause;                 ///< skips packets after those without a common hit
    RayBundle<Real>* bundle = nullptr;
    std::size_t bytes = 0;

    /// With a null `scratch`, only `bytes` is valid.
    StreamWork(void* scratch, const abi::SceneView<Real>& scene)
    {
        Arena arena(scratch);
        take_objects<F>(arena, nearby, scene);
        if constexpr (F.exact)
            if (scene.tree.empty())
                common.take(arena, scene);
        if (F.exact || scene.tree.empty())
            take_objects<F>(arena, from_point, scene);
        if (!scene.tree.empty())
            bundle = take_bundle<F, Real>(arena);
        bytes = arena.used();
    }

    /// Whether to search packets of a chunk for common hits. Rays in different directions have
    /// none, and few rays are not worth the preparation.
    bool looks_for_common(const abi::RaysView<Real>& view, int begin, int count)
    {
        common.are_all = false;
        return wants_common && count >= fewest_in_common && view.start_surface == nullptr &&
               run_together(view, begin);
    }
    static constexpr int fewest_in_common = 256;
};

/// With fewer rays, preparing objects for a shared origin does not pay.
inline constexpr int fewest_sharing = 64;

/// Whether all rays of a chunk start at the same point, as rays from a camera or a light do. Zeros
/// of different sign are not the same, so that results have the same bits either way.
template <class Real>
inline bool start_together(const abi::RaysView<Real>& view, int begin, int count)
{
    if (count < fewest_sharing)
        return false;
    const Real* const x = view.org[0] + begin;
    const Real* const y = view.org[1] + begin;
    const Real* const z = view.org[2] + begin;
    const Vec3v<Real> one{vreal<Real>(*x), vreal<Real>(*y), vreal<Real>(*z)};
    const auto differs = [](const vreal<Real>& a, const vreal<Real>& b) {
        return as_int(a) ^ as_int(b);
    };
    // The last packet may overlap the one before it.
    for (int first = 0; first < count;) {
        const int at = first + lanes<Real> <= count ? first : count - lanes<Real>;
        const vint<Real> any_differs = differs(load(x + at), one.x) | differs(load(y + at), one.y) |
                                       differs(load(z + at), one.z);
        if (bits(int_equal(any_differs, vint<Real>(lane_int<Real>(0)))) != all_lanes<Real>)
            return false;
        first = at + lanes<Real>;
    }
    return true;
}

/// The box of a chunk's origins, and the cone of its directions. The cone is not bounded if that
/// cannot be decided.
struct ChunkBounds {
    Box<float> box;
    Cone<float> cone;
};

inline ChunkBounds bounds_of_chunk(const abi::RaysView<float>& view, int begin, int count)
{
    PacketBox<float> origins;
    vmask<float> certain = from_bits<float>(all_lanes<float>);
    vreal<float> reach2(0.0f);
    for (int ray = 0; ray < count; ray += lanes<float>) {
        origins.add(load_some3(view.org, begin + ray, count - ray));
        RayPacket<float> rays;
        rays.dir = load_some3(view.dir, begin + ray, count - ray);
        rays.dir2 = dot(rays.dir, rays.dir);
        rays.t_min = load_some(view.t_min + begin + ray, count - ray);
        certain = certain & certifiable(rays) & (rays.t_min >= vreal<float>(0.0f));
        const vreal<float> t_max = load_some(view.t_max + begin + ray, count - ray);
        // Rays with a NaN as their end hit nothing.
        reach2 = max(reach2, rays.dir2 * t_max * t_max);
    }
    ChunkBounds bounds;
    bounds.box = origins.box();
    const Origins start = origins_in(bounds.box.low, bounds.box.high);
    if (!all(certain) || !certifiable(start))
        return bounds;
    bounds.cone = cone_of(start.center, start.radius,
                          {view.dir[0] + begin, view.dir[1] + begin, view.dir[2] + begin}, count);
    const float reach = square_root(largest_lane<float>(reach2)) * inflation + start.radius;
    if (reach < largest_reach<float>)
        bounds.cone.reach = reach;
    return bounds;
}

/// With fewer rays, picking does not pay.
inline constexpr int fewest_picking = 64;

/// Puts the objects that a chunk's rays may hit into lists, including those of the BVH, if that is
/// likely to pay. Returns false if the rays have to traverse the BVH.
template <abi::Features F>
inline bool pick_for_chunk(StreamWork<F, float>& work, const abi::SceneView<float>& scene,
                           const abi::RaysView<float>& view, int begin, int count)
{
    if (count < fewest_picking || !work.picking.is_over() || !run_together(view, begin))
        return false;
    const ChunkBounds bounds = bounds_of_chunk(view, begin, count);
    work.picking.record_failure();
    if (!bounds.cone.bounded)
        return false;
    work.shares_origin = view.start_surface == nullptr && start_together(view, begin, count);
    if (work.shares_origin) {
        find_objects<F>(work.from_point, bounds.cone, scene);
        work.by_lists = picks_all<F>(work.from_point, bounds.cone, scene);
        sort_by_distance<F>(work.from_point);
    } else {
        find_nearby<F>(work.nearby, bounds.box, bounds.cone, scene);
        work.by_lists = picks_all<F>(work.nearby, bounds.box, bounds.cone, scene);
    }
    if (work.by_lists)
        work.picking.record_success();
    return work.by_lists;
}

/// Prepares the lists for a chunk of a stream.
template <abi::Features F, class Real>
inline void find_nearby_of(StreamWork<F, Real>& work, const abi::SceneView<Real>& scene,
                           const abi::RaysView<Real>& view, int begin, int count)
{
    work.by_lists = scene.tree.empty();
    if constexpr (F.exact)
        if (!work.by_lists && pick_for_chunk(work, scene, view, begin, count))
            return;
    work.shares_origin =
        work.by_lists && view.start_surface == nullptr && start_together(view, begin, count);
    const Real first[3] = {view.org[0][begin], view.org[1][begin], view.org[2][begin]};
    if (work.shares_origin) {
        find_from_point<F, Real>(work.from_point, first, scene);
        sort_by_distance<F>(work.from_point);
        if constexpr (F.exact)
            if (work.looks_for_common(view, begin, count))
                fill_common(work.common, scene, near_origins(scene, first, first), first);
        return;
    }
    if constexpr (F.exact) {
        // If all objects are in the BVH, it has error bounds of its own.
        if (!scene.tree.empty() && !has_objects<F>(scene))
            return;
        PacketBox<float> origins;
        for (int ray = 0; ray < count; ray += lanes<float>)
            origins.add(load_some3(view.org, begin + ray, count - ray));
        const Box<float> box = origins.box();
        find_objects<F>(work.nearby, origins_in(box.low, box.high), scene);
        if (work.looks_for_common(view, begin, count))
            fill_common(work.common, scene, near_origins(scene, box.low, box.high), first);
    } else {
        find_objects<F>(work.nearby, Cone<Real>{}, scene);
    }
}

/// The number of rays for which lists are prepared together, without a BVH.
inline constexpr int list_chunk = 16 * bundle_rays;

/// Prepares the lists for each chunk of a stream, and calls `visit(begin, end)` for it.
template <abi::Features F, class Real, class Visit>
inline void for_each_chunk(StreamWork<F, Real>& work, const abi::SceneView<Real>& scene,
                           const abi::RaysView<Real>& view, const Visit& visit)
{
    const int chunk = scene.tree.empty() ? list_chunk : bundle_rays;
    for (int begin = 0; begin < view.count; begin += chunk) {
        const int end = view.count - begin < chunk ? view.count : begin + chunk;
        find_nearby_of(work, scene, view, begin, end - begin);
        visit(begin, end);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
