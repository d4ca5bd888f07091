#pragma once

#include "kernels/fused/plan.hpp"
#include "kernels/stream/camera_rays.hpp"
#include "kernels/stream/probe.hpp"

// Packets of paths, from the eye to the last mirror, and the memory of a thread for them.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The share of a path's light: one number, or one a channel where any mirror is tinted.
template <bool Colored>
struct PathWeight {
    vreal<float> one;

    [[nodiscard]] Vec3v<float> of(const Vec3v<float>& light) const
    {
        return scale<float>(one, light);
    }
    void reflect(const Vec3v<float>& share)
    {
        one = one * share.x;
    }
};
template <>
struct PathWeight<true> {
    Vec3v<float> each;

    [[nodiscard]] Vec3v<float> of(const Vec3v<float>& light) const
    {
        return each * light;
    }
    void reflect(const Vec3v<float>& share)
    {
        each = each * share;
    }
};

inline void set_whole(PathWeight<false>& weight)
{
    weight.one = vreal<float>(1.0f);
}
inline void set_whole(PathWeight<true>& weight)
{
    const vreal<float> one(1.0f);
    weight.each = {one, one, one};
}

/// Whether rays of a generation come from the eye.
enum class Generation { camera, mirrored };

/// Rays of a packet of paths, and what they bring to their pixels so far.
template <abi::Features F>
struct PathState {
    Vec3v<float> org;
    Vec3v<float> dir;
    vreal<float> dir2;
    PathWeight<F.colored> weight;
    Vec3v<float> color;
    std::uint32_t active;  ///< lanes whose path goes on
    bool is_far;           ///< some start beyond the plan's origins
    bool is_plain;         ///< find_common_hit() may be asked
};

/// Hits of a packet of paths.
struct HitState {
    Vec3v<float> point;
    Vec3v<float> outward;  ///< unit normal
    vint<float> number;    ///< of the surfaces; set where they differ
    std::int32_t common;   ///< the surface that all are on; -1 for several
    std::uint32_t lanes;
};

/// What the rays of a packet start on; the hits of a generation take the place of those before.
struct PathStart {
    HitState at;
    std::int32_t common;      ///< the surface that all rays which go on start on; -1 for several
    bool meets_own;           ///< some may meet the same body again, as `second` says
    SecondHit<float> second;  ///< set where meets_own
};

inline vint<float> numbers_of(const HitState& hit)
{
    return hit.common >= 0 ? vint<float>(lane_int<float>{hit.common}) : hit.number;
}

/// The memory of a thread for a tile.
template <abi::Features F>
struct FusedMemory {
    float* color = nullptr;
    CommonLists candidates;                       ///< what the eye may see through the tile
    FilteredObjects<true> visible;                ///< likewise, where tests are dear
    FilteredObjects<false> from_far;              ///< for mirrored rays beyond the plan's origins
    LightObjects<F, float>* occluders = nullptr;  ///< likewise, by light that sends no rays
    std::size_t bytes = 0;

    /// With no `scratch`, only `bytes` is of use.
    FusedMemory(void* scratch, const abi::SceneView<float>& scene)
    {
        Arena arena(scratch);
        color = arena.take<float>(tile_elements);
        candidates.take(arena, scene);
        if constexpr (F.quadrics)
            take_objects<F>(arena, visible, scene);
        if (scene.rules.max_depth > 0)
            take_objects<F>(arena, from_far, scene);
        occluders = arena.take<LightObjects<F, float>>(
            static_cast<std::size_t>(scene.lighting.lights.count));
        LightObjects<F, float> measured;
        for (int i = 0; i < scene.lighting.lights.count; ++i)
            if (!scene.lighting.lights.data[i].sends_rays)
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

template <Generation G, abi::Features F>
inline float least_t(const FusedTile<F>& tile)
{
    return G == Generation::camera ? tile.eye_t_min : tile.scene.rules.secondary_t_min;
}

template <Generation G, abi::Features F>
inline RayPacket<float> rays_of(const FusedTile<F>& tile, const PathState<F>& path)
{
    const vreal<float> t_min(least_t<G>(tile));
    if constexpr (G == Generation::camera)
        return {broadcast(tile.eye), path.dir, path.dir2, t_min};
    else
        return {path.org, path.dir, path.dir2, t_min};
}

inline StartPacket<float> start_of(const PathStart& start)
{
    const vint<float> number = numbers_of(start.at);
    if (start.meets_own)
        return {start.at.point, number, start.second};
    return {start.at.point, number, no_second_hit<float>()};
}

/// The surface of each ray's start, which its search passes over, for rays that count alone.
struct ActiveOwn {
    const vint<float>& surface;
    std::int32_t common;
    std::uint32_t active;

    bool all_on(const Body& body) const
    {
        return is_on(body, common);
    }
    template <class Real>
    std::uint32_t lanes_on_others(std::int32_t first, int pieces = 1) const
    {
        return common >= 0 ? active : active & ~lanes_on_body<Real>(surface, first, pieces);
    }
};

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
