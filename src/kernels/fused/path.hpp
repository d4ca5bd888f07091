#pragma once

#include "kernels/fused/plan.hpp"
#include "kernels/stream/camera_rays.hpp"
#include "kernels/stream/probe.hpp"

// Packets of paths, from the eye to the last mirror, and the memory of a thread for them.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Rays of a packet of paths, and what they bring to their pixels so far.
struct PathState {
    Vec3v<float> org;
    Vec3v<float> dir;
    vreal<float> dir2;
    vreal<float> weight;
    Vec3v<float> color;
    std::uint32_t active;    ///< lanes whose path goes on
    std::int32_t own;        ///< the surface that all of them start on; -1: none, or several
    bool is_far;             ///< some start beyond the plan's origins
    bool is_plain;           ///< find_common_hit() may be asked
    bool meets_own;          ///< some may meet the body again that they start on, as `second` says
    SecondHit<float> second; ///< set where meets_own
};

/// Hits of a packet of paths; those that paths start on until the next are found.
struct HitState {
    Vec3v<float> point;
    Vec3v<float> outward;  ///< unit normal
    Vec3v<float> normal;   ///< turned against the ray where the surface's is
    vint<float> number;    ///< of the surfaces
    vreal<float> normal_dir;  ///< N·D
    vreal<float> floor_dir2;  ///< squared cosine below which nothing shines, times D·D
    Vec3v<float> color;       ///< of their own light
    const MaterialPacket<float>* material;
    std::uint32_t lanes;
    std::uint32_t leaving;  ///< lanes that come from the inside
    std::int32_t common;    ///< the surface that all are on; -1 for several
    bool is_far;            ///< some are beyond the plan's origins
};

/// A packet of paths while it is traced.
struct PacketWork {
    PathState path;
    HitState hit;
    MaterialPacket<float> mixed;  ///< of hits that do not share one
};

/// Packets are traced side by side, stage by stage: while one waits for a root or a division, the
/// processor goes on with the next.
inline constexpr int packets_at_once = 4;

/// Materials of packets that share one, by number.
class MaterialCache {
public:
    void clear()
    {
        for (lane_int<float>& number : number_)
            number = -1;
    }

    const MaterialPacket<float>& fetch(const abi::SceneView<float>& scene, std::int32_t number)
    {
        const int slot = number % slots;
        if (number_[slot] != number) {
            number_[slot] = number;
            material_[slot] = fetch_materials(scene, vint<float>(number), all_lanes<float>);
        }
        return material_[slot];
    }

private:
    // More than a chunk of packets has.
    static constexpr int slots = 8;
    static_assert(slots > packets_at_once);
    MaterialPacket<float> material_[slots];
    lane_int<float> number_[slots];
};

/// The memory of a thread for a tile.
template <abi::Features F>
struct FusedMemory {
    TilePixelColors<float>* color = nullptr;
    PacketWork* packets = nullptr;
    MaterialCache* materials = nullptr;
    FilteredObjects<true> visible;            ///< from the eye through the tile
    std::uint8_t* visible_spheres = nullptr;  ///< the same, by their numbers in the plan
    std::uint8_t* visible_grounds = nullptr;
    FilteredObjects<false> from_far;              ///< for a packet of origins beyond the plan's
    LightObjects<F, float>* occluders = nullptr;  ///< likewise, by light
    std::size_t bytes = 0;

    /// With no `scratch`, only `bytes` is of use.
    FusedMemory(void* scratch, const abi::SceneView<float>& scene)
    {
        Arena arena(scratch);
        color = arena.take<TilePixelColors<float>>(1);
        packets = arena.take<PacketWork>(packets_at_once);
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
    float eye_t_min;
};

/// Whether rays of a generation come from the eye.
enum class Generation { camera, mirrored };

template <Generation G, abi::Features F>
inline float least_t(const FusedTile<F>& tile)
{
    return G == Generation::camera ? tile.eye_t_min : tile.scene.rules.secondary_t_min;
}

template <Generation G, abi::Features F>
inline RayPacket<float> rays_of(const FusedTile<F>& tile, const PathState& path)
{
    const vreal<float> t_min(least_t<G>(tile));
    if constexpr (G == Generation::camera)
        return {broadcast(tile.eye), path.dir, path.dir2, t_min};
    else
        return {path.org, path.dir, path.dir2, t_min};
}

/// What paths start on, which stands in the hits of the generation before.
inline StartPacket<float> start_of(const PacketWork& work)
{
    if (work.path.meets_own)
        return {work.hit.point, work.hit.number, work.path.second};
    return {work.hit.point, work.hit.number, no_second_hit<float>()};
}

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
