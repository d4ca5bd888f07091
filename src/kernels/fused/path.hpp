#pragma once

#include "kernels/fused/plan.hpp"
#include "kernels/stream/camera_rays.hpp"
#include "kernels/stream/probe.hpp"

// A packet of paths, from the eye to the last mirror, while it is traced in registers.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A packet of paths: the rays of one generation, with what they bring to their pixels.
struct PathState {
    RayPacket<float> rays;
    StartPacket<float> start;
    vreal<float> weight;
    Vec3v<float> color;    ///< of the pixels so far
    std::uint32_t active;  ///< lanes whose path goes on
    std::int32_t own;      ///< what all of them start on; -1 for nothing, or several surfaces
    bool is_far;           ///< some start beyond the plan's origins
    bool is_plain;         ///< find_common_hit() may be asked
};

/// Materials of packets, by number; those of packets that share one are kept.
class MaterialCache {
public:
    void clear()
    {
        for (lane_int<float>& number : number_)
            number = -1;
    }

    const MaterialPacket<float>& fetch(const abi::SceneView<float>& scene,
                                       const SurfacePacket<float>& surface, std::uint32_t active)
    {
        const lane_int<float> number = surface.common_material;
        if (number < 0) {
            mixed_ = fetch_materials(scene, surface.material, active);
            return mixed_;
        }
        const int slot = number % slots;
        if (number_[slot] != number) {
            number_[slot] = number;
            material_[slot] = fetch_materials(scene, vint<float>(number), all_lanes<float>);
        }
        return material_[slot];
    }

private:
    static constexpr int slots = 8;
    MaterialPacket<float> material_[slots];
    MaterialPacket<float> mixed_;
    lane_int<float> number_[slots];
};

/// The memory of a thread for a tile.
template <abi::Features F>
struct FusedMemory {
    TilePixelColors<float>* color = nullptr;
    MaterialCache* materials = nullptr;
    FilteredObjects<true> visible;                ///< from the eye through the tile
    std::uint8_t* visible_spheres = nullptr;      ///< the same, by their numbers in the plan
    std::uint8_t* visible_grounds = nullptr;
    FilteredObjects<false> from_far;              ///< for a packet of origins beyond the plan's
    LightObjects<F, float>* occluders = nullptr;  ///< likewise, by light
    std::size_t bytes = 0;

    /// With no `scratch`, only `bytes` is of use.
    FusedMemory(void* scratch, const abi::SceneView<float>& scene)
    {
        Arena arena(scratch);
        color = arena.take<TilePixelColors<float>>(1);
        materials = arena.take<MaterialCache>(1);
        take_objects<F>(arena, visible, scene);
        visible_spheres = arena.take<std::uint8_t>(static_cast<std::size_t>(scene.spheres.count));
        visible_grounds =
            arena.take<std::uint8_t>(static_cast<std::size_t>(scene.anchored_spheres.count));
        take_objects<F>(arena, from_far, scene);
        occluders = arena.take<LightObjects<F, float>>(
            static_cast<std::size_t>(scene.lighting.lights.count));
        LightObjects<F, float> measured;
        for (int i = 0; i < scene.lighting.lights.count; ++i)
            take_occluders<F, float>(arena, scratch != nullptr ? occluders[i] : measured, scene,
                                     scene.lighting.lights.data[i]);
        bytes = arena.used();
    }
};

/// What stays the same while a tile is traced.
template <abi::Features F>
struct FusedTile {
    const abi::SceneView<float>& scene;
    const FramePlan<F>& plan;
    FusedMemory<F>& memory;
    abi::RayCounts& counts;
    float eye[3];
};

/// The surface of each ray's start, which its search passes over, for rays that count alone.
struct ActiveOwn {
    const vint<float>& surface;
    std::int32_t common;
    std::uint32_t active;

    bool all_on(const Body& body) const
    {
        return common >= body.first && common < body.first + body.pieces;
    }
    template <class Real>
    std::uint32_t lanes_on_others(std::int32_t first, int pieces = 1) const
    {
        return common >= 0 ? active : active & ~lanes_on_body<Real>(surface, first, pieces);
    }
};

/// The lanes whose places error bounds of the plan don't hold for.
template <abi::Features F>
inline std::uint32_t far_lanes(const FramePlan<F>& plan, const Vec3v<float>& place)
{
    // The cube in the ball of origins.
    const vreal<float> edge(plan.origins.radius * 0.57f);
    const Vec3v<float> from = place - broadcast(plan.origins.center);
    return ~bits((abs(from.x) <= edge) & (abs(from.y) <= edge) & (abs(from.z) <= edge)) &
           all_lanes<float>;
}

/// The ball around the places of some lanes.
inline Origins origins_of_lanes(const Vec3v<float>& place, std::uint32_t active)
{
    const LaneVectors<float> by_lane(place);
    float low[3];
    float high[3];
    const int first = __builtin_ctz(active);
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = high[axis] = by_lane.axis[axis][first];
        for (std::uint32_t left = active; left != 0; left &= left - 1) {
            const float x = by_lane.axis[axis][__builtin_ctz(left)];
            low[axis] = min(low[axis], x);
            high[axis] = max(high[axis], x);
        }
    }
    // Shadow rays start off the places.
    return origins_in(low, high);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
