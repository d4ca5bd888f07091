#pragma once

#include "kernels/fused/generation.hpp"
#include "kernels/fused/make_plan.hpp"
#include "kernels/stream/tile.hpp"

#include <new>

// Renders a tile by tracing packets of paths one after another, each from the camera to its last
// mirror in registers, without streams and compaction. For scenes whose objects are in lists and
// whose hits have at most one child ray.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Whether every quadric and polygon has a finite bounding ball.
inline bool are_bounded(const abi::GeometryView<float>& scene)
{
    bool bounded = true;
    for_each_other(scene,
                   [&](const auto& record) { bounded &= record.bound_radius < __builtin_inff(); });
    return bounded;
}

/// In fast mode reflected rays are tested against all objects. With more of them, streams, which
/// find those near, are faster.
inline constexpr int most_mirrored_in_fast = 16;

template <abi::Features F>
inline bool can_fuse(const abi::SceneView<float>& scene)
{
    const bool few = has_few_objects(scene) && (F.exact || scene.rules.max_depth == 0 ||
                                                listed_objects(scene) <= most_mirrored_in_fast);
    return few && (scene.wide != nullptr) == F.exact && are_bounded(scene) &&
           !scene.lighting.flat && scene.rules.start_error > 0 && !(scene.rules.min_weight > 0);
}

template <abi::Features F>
inline std::size_t plan_bytes(const abi::SceneView<float>& scene)
{
    return can_fuse<F>(scene) ? FramePlan<F>(nullptr, scene).bytes : 0;
}

template <abi::Features F>
inline std::size_t fused_scratch_bytes(const abi::SceneView<float>& scene)
{
    return FusedMemory<F>(nullptr, scene).bytes;
}

/// `memory` has plan_bytes().
template <abi::Features F>
inline void make_plan(const abi::SceneView<float>& scene, const abi::CameraView<float>& camera,
                      void* memory)
{
    auto* const plan = new (memory) FramePlan<F>(memory, scene);
    fill_plan(*plan, scene, camera);
}

/// Finds the objects for find_common_hit() that camera rays through a tile may hit.
template <abi::Features F>
inline void find_candidates(const FusedTile<F>& tile, const Cone<float>& cone)
{
    const FramePlan<F>& plan = tile.plan;
    CommonLists& candidates = tile.memory.candidates;
    for_each_met(cone, tile.scene.spheres, [&](int first, std::uint32_t kept, const Vec3v<float>&) {
        for (; kept != 0; kept &= kept - 1)
            candidates.spheres.next() = plan.common.spheres.first[first + __builtin_ctz(kept)];
    });
    // In the order of the plan's grounds.
    const CommonGround* ground = plan.common.grounds.first;
    const auto add = [&](const auto& list) {
        for (int i = 0; i < list.count; ++i, ++ground)
            if (!leaves_behind(cone, list.data[i]))
                candidates.grounds.next() = *ground;
    };
    add(list_of<AnchoredSphere>(plan.from_camera));
    add(list_of<Plane>(plan.from_camera));
    if constexpr (F.quadrics) {
        const CommonBall* ball = plan.common.balls.first;
        for_each_other(tile.scene, [&](const auto& record) {
            if (!out_of_reach(cone, record))
                candidates.balls.next() = *ball;
            ++ball;
        });
    }
}

/// Finds the objects that camera rays through a tile may hit; returns whether there are any.
template <abi::Features F>
inline bool find_visible(const FusedTile<F>& tile, const Cone<float>& cone)
{
    FusedMemory<F>& memory = tile.memory;
    if constexpr (lists_by_tile<F>) {
        find_objects<F>(memory.visible, cone, tile.scene);
        sort_by_distance<F>(memory.visible);
    }
    if constexpr (F.exact) {
        find_candidates(tile, cone);
        return !memory.candidates.empty();
    } else {
        return !memory.visible.empty();
    }
}

/// Traces the paths of a packet of camera rays; returns their colours.
template <abi::Features F>
inline Vec3v<float> trace_paths(const FusedTile<F>& tile, const RayPacket<float>& rays,
                                std::uint32_t active)
{
    PathState<F> path;
    PathStart start;
    path.dir = rays.dir;
    path.dir2 = rays.dir2;
    path.weight.set_whole();
    path.active = active;
    path.is_far = false;
    // Reflection changes the length of a direction only by rounding.
    path.is_plain = tile.plan.common.are_all && (active & ~bits(certifiable(rays))) == 0;
    trace_generation<Generation::camera>(tile, tile.memory.candidates, path, start, 0);
    for (int depth = 1; path.active != 0; ++depth)
        trace_generation<Generation::reflected>(tile, tile.plan.common, path, start, depth);
    return path.color;
}

template <abi::Features F>
inline abi::RayCounts trace_fused_tile(const abi::TileJob<float>& job)
{
    const abi::SceneView<float>& scene = *job.scene;
    FusedMemory<F> memory(job.scratch, scene);
    abi::RayCounts counts;
    counts.camera =
        static_cast<unsigned>(job.samples != nullptr ? job.samples->count : job.width * job.height);
    fetch_picture(job);
    const auto& plan = *static_cast<const FramePlan<F>*>(job.plan);
    const float(&origin)[3] = job.camera->origin;
    const FusedTile<F> tile{
        scene, plan, memory, counts, {origin[0], origin[1], origin[2]}, job.camera->t_min};
    if (!find_visible(tile, camera_cone(job)) && !(scene.lighting.seen_within > 0)) {
        fill_pixels(memory.color, scene.rules.background);
        write_tile(job, memory.color);
        return counts;
    }
    const TileCamera<float> camera(job);
    for (int first = 0; first < abi::tile_pixels; first += lanes<float>) {
        const std::uint32_t active = lanes_inside(job, first);
        if (active == 0)
            continue;
        const RayPacket<float> rays = camera_rays(camera, first, scene.rules.units);
        const Vec3v<float> color = trace_paths(tile, rays, active);
        store_pixels(memory.color + pixel_elements * first, color.x, color.y, color.z);
    }
    write_tile(job, memory.color);
    return counts;
}

template <abi::Features F>
inline abi::RayCounts trace_fused_tiles(const abi::TileJob<float>* tiles, int count)
{
    abi::RayCounts counts;
    for (int tile = 0; tile < count; ++tile)
        counts += trace_fused_tile<F>(tiles[tile]);
    return counts;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
