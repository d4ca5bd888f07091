#pragma once

#include <new>

#include "kernels/fused/generation.hpp"
#include "kernels/fused/make_plan.hpp"
#include "kernels/stream/tile.hpp"

// A tile whose packets of paths are traced one after the other, each from the eye to its last
// mirror in registers: no streams, no compaction. For scenes whose objects stand in lists, and
// where a hit has one child at most.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// More objects than these are better culled for chunks of rays, as streams do it.
inline constexpr int most_fused_objects = 32;

template <abi::Features F>
inline bool can_fuse(const abi::SceneView<float>& scene)
{
    const int objects = scene.spheres.count + scene.anchored_spheres.count + scene.planes.count;
    return scene.wide != nullptr && scene.tree.empty() && scene.quadrics.count == 0 &&
           scene.polygons.count == 0 && objects <= most_fused_objects && !scene.lighting.flat &&
           scene.rules.start_error > 0 && !(scene.rules.min_weight > 0);
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

/// `memory` is of plan_bytes().
template <abi::Features F>
inline void make_plan(const abi::SceneView<float>& scene, const abi::CameraView<float>& camera,
                      void* memory)
{
    auto* const plan = new (memory) FramePlan<F>(memory, scene);
    fill_plan(*plan, scene, camera);
}

/// Fills `numbers` with the places in the plan's list of those objects that a list holds, which has
/// them in the same order.
template <class List, class Object>
inline int number_objects(std::uint8_t* numbers, const List& list, const Object* objects)
{
    int number = 0;
    for (int i = 0; i < list.count; ++i) {
        while (objects[number].surface != body_of(object_at(list, i)).first)
            ++number;
        numbers[i] = static_cast<std::uint8_t>(number);
    }
    return list.count;
}

template <abi::Features F>
inline Candidates number_visible(const FramePlan<F>& plan, const FusedMemory<F>& memory)
{
    Candidates candidates{memory.visible_spheres, memory.visible_grounds};
    candidates.sphere_count = number_objects(memory.visible_spheres,
                                             list_of<Sphere>(memory.visible), plan.spheres);
    candidates.ground_count = number_objects(memory.visible_grounds,
                                             list_of<AnchoredSphere>(memory.visible), plan.grounds);
    return candidates;
}

/// Traces the paths of a packet of camera rays, from number `first` on; returns their colours.
template <abi::Features F>
inline Vec3v<float> trace_paths(const FusedTile<F>& tile, const Candidates& visible,
                                const Candidates& all, const RayPacket<float>& rays,
                                std::uint32_t active)
{
    PathState path;
    PathStart start;
    path.dir = rays.dir;
    path.dir2 = rays.dir2;
    path.weight = vreal<float>(1.0f);
    path.active = active;
    path.is_far = false;
    // Mirrors keep lengths but for a little.
    path.is_plain = tile.plan.has_common_hits && (active & ~bits(certifiable(rays))) == 0;
    trace_generation<Generation::camera>(tile, visible, path, start, 0);
    for (int depth = 1; path.active != 0; ++depth)
        trace_generation<Generation::mirrored>(tile, all, path, start, depth);
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
    find_objects<F>(memory.visible, camera_cone(job), scene);
    if (memory.visible.empty() && !(scene.lighting.seen_within > 0)) {
        fill_pixels(*memory.color, scene.rules.background);
        write_tile(job, *memory.color);
        return counts;
    }
    const auto& plan = *static_cast<const FramePlan<F>*>(job.plan);
    const float(&eye)[3] = job.camera->origin;
    const FusedTile<F> tile{
        scene, plan, memory, counts, {eye[0], eye[1], eye[2]}, job.camera->t_min};
    const Candidates visible = number_visible(plan, memory);
    const Candidates all{plan.numbers, plan.numbers, scene.spheres.count,
                         scene.anchored_spheres.count};
    const TileCamera<float> camera(job);
    for (int first = 0; first < abi::tile_pixels; first += lanes<float>) {
        const std::uint32_t active = lanes_inside(job, first);
        if (active == 0)
            continue;
        const RayPacket<float> rays = camera_rays(camera, first, scene.rules.units);
        const Vec3v<float> color = trace_paths(tile, visible, all, rays, active);
        store_pixels(*memory.color + pixel_elements * first, color.x, color.y, color.z);
    }
    write_tile(job, *memory.color);
    return counts;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
