#pragma once

#include "kernels/fused/path.hpp"
#include "kernels/precision/refine.hpp"
#include "kernels/retrace/retrace_closest.hpp"
#include "kernels/stream/trace_stream.hpp"

// Finds the hits of one generation of a packet of paths. The operations, and so the bits, are those
// of streams.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The objects for reflected rays that start outside the plan's origins.
template <abi::Features F>
[[gnu::noinline]] const FilteredObjects<Origin::any>& objects_from_far(const FusedTile<F>& tile,
                                                                       const Vec3v<float>& place,
                                                                       std::uint32_t active)
{
    FilteredObjects<Origin::any>& objects = tile.memory.from_far;
    find_objects<F>(objects, origins_of_lanes(place, active), tile.scene);
    return objects;
}

/// The objects for a tile's camera rays.
template <abi::Features F>
inline const FromPoint<F, float>& objects_from_camera(const FusedTile<F>& tile)
{
    return lists_by_tile<F> ? tile.memory.visible : tile.plan.from_camera;
}

/// The closest hits of a packet by the search in lists with error bounds, where find_common_hit()
/// cannot decide. Its parameters are copies, so that the caller's values stay in registers.
template <Generation G, abi::Features F>
[[gnu::noinline]] void find_any_hits(HitState& hit, const FusedTile<F>& tile,
                                     const RayPacket<float>& rays, bool is_far,
                                     const PathStart& path_start, std::uint32_t active)
{
    const vreal<float> no_end_yet(__builtin_inff());
    const StartPacket<float> start =
        G == Generation::camera ? no_start<float>() : start_of(path_start);
    HitPacket<float> found = start_of_search<F>(start, rays.dir2, no_end_yet);
    if constexpr (G == Generation::camera) {
        closest_hit<F>(found, objects_from_camera(tile), rays, NoOwn{});
    } else {
        const FilteredObjects<Origin::any>& objects =
            is_far ? objects_from_far(tile, rays.org, active) : tile.plan.from_near;
        closest_hit<F>(found, objects, rays, ActiveOwn{start.surface, path_start.common, active});
    }
    count_unsure(tile.counts,
                 correct_packet<F>(tile.scene, rays, found, start, no_end_yet, active));
    hit.lanes = hit_lanes(found) & active;
    if (hit.lanes == 0)
        return;
    const RefinedHits<float> places =
        refined<F, Refine::place>(tile.scene.shapes, rays, found, start, hit.lanes);
    hit.point = places.point;
    hit.outward = places.normal;
    hit.number = found.surface;
    hit.common = static_cast<std::int32_t>(common_number<float>(found.surface, hit.lanes));
}

/// The closest hits of a packet by the search in lists in fast mode.
template <Generation G, abi::Features F>
inline void find_rough_hits(HitState& hit, const FusedTile<F>& tile, const RayPacket<float>& rays,
                            const PathStart& path_start, std::uint32_t active)
{
    StartPacket<float> start = no_start<float>();
    HitPacket<float> found = no_hit<float>(__builtin_inff());
    const bool meets_own = G == Generation::reflected && path_start.meets_own;
    if (meets_own) {
        start = start_of(path_start);
        found = start_of_search<F>(start, rays.dir2, vreal<float>(__builtin_inff()));
    }
    if constexpr (G == Generation::camera)
        closest_hit<F>(found, objects_from_camera(tile), rays, NoOwn{});
    else
        closest_hit<F>(found, tile.plan.from_near, rays,
                       ActiveOwn{numbers_of(path_start.at), path_start.common, active});
    hit.lanes = hit_lanes(found) & active;
    if (hit.lanes == 0)
        return;
    hit.number = found.surface;
    hit.common = static_cast<std::int32_t>(common_number<float>(found.surface, hit.lanes));
    if (hit.common >= 0 && !meets_own) {
        const abi::ShapesView& shapes = tile.scene.shapes;
        hit.point = madd<float>(found.t, rays.dir, rays.org);
        hit.outward = surface_normal<float>(shapes, shapes.index[hit.common], hit.point, rays.dir);
        return;
    }
    const RefinedHits<float> places =
        refined<F, Refine::place>(tile.scene.shapes, rays, found, start, hit.lanes);
    hit.point = places.point;
    hit.outward = places.normal;
}

/// Finds the hits of the active rays of a packet if find_common_hit() can.
template <Generation G, abi::Features F>
inline bool find_common(HitState& hit, const FusedTile<F>& tile, const CommonLists& candidates,
                        const PathState<F>& path, std::int32_t own)
{
    constexpr Origin origin = G == Generation::camera ? Origin::shared : Origin::any;
    CommonHit common;
    if (!path.is_plain || !find_common_hit<Refine::place, origin>(
                              common, tile.plan.common, candidates, rays_of<G>(tile, path),
                              tile.camera_origin, own, path.active))
        return false;
    hit.point = common.point;
    hit.outward = common.outward;
    hit.common = common.surface;
    hit.lanes = common.lanes;
    return true;
}

/// Finds the hits of the active rays of a packet.
template <Generation G, abi::Features F>
inline void find_hits(const FusedTile<F>& tile, const CommonLists& candidates,
                      const PathState<F>& path, PathStart& start)
{
    // The search gets the address of copies only, so that all other values stay in registers.
    HitState found;
    if constexpr (F.exact) {
        const std::int32_t own = G == Generation::camera ? -1 : start.common;
        if (find_common<G>(start.at, tile, candidates, path, own))
            return;
        const RayPacket<float> rays = rays_of<G>(tile, path);
        find_any_hits<G>(found, tile, rays, path.is_far, start, path.active);
    } else {
        find_rough_hits<G>(found, tile, rays_of<G>(tile, path), start, path.active);
    }
    start.at = found;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
