#pragma once

#include "kernels/fused/plan.hpp"
#include "kernels/stream/camera_rays.hpp"
#include "kernels/stream/probe.hpp"

// Packets of paths, from the camera to the last mirror, and the memory of a thread for them.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The weight of a path: one number, or one per channel if any mirror is tinted.
template <bool Colored>
struct PathWeight {
    vreal<float> one;

    void set_whole()
    {
        one = vreal<float>(1.0f);
    }
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

    void set_whole()
    {
        const vreal<float> one(1.0f);
        each = {one, one, one};
    }
    [[nodiscard]] Vec3v<float> of(const Vec3v<float>& light) const
    {
        return each * light;
    }
    void reflect(const Vec3v<float>& share)
    {
        each = each * share;
    }
};

/// Whether the rays of a generation come from the camera.
enum class Generation { camera, reflected };

/// The rays of a packet of paths, and the colour of their pixels so far.
template <abi::Features F>
struct PathState {
    Vec3v<float> org;
    Vec3v<float> dir;
    vreal<float> dir2;
    PathWeight<F.colored> weight;
    Vec3v<float> color;
    std::uint32_t active;  ///< lanes whose path continues
    bool is_far;           ///< some start outside the plan's origins
    bool is_plain;         ///< find_common_hit() can be used
};

/// The hits of a packet of paths.
struct HitState {
    Vec3v<float> point;
    Vec3v<float> outward;  ///< unit normal
    vint<float> number;    ///< surface numbers; set only if they differ
    std::int32_t common;   ///< the surface that all hits are on; -1 if they differ
    std::uint32_t lanes;
};

/// Where the rays of a packet start. The hits of a generation replace those of the previous one.
struct PathStart {
    HitState at;
    std::int32_t common;      ///< the surface that all active rays start on; -1 if they differ
    bool meets_own;           ///< some may hit the same object again, at `second`
    SecondHit<float> second;  ///< only set if meets_own
};

inline vint<float> numbers_of(const HitState& hit)
{
    return hit.common >= 0 ? vint<float>(lane_int<float>{hit.common}) : hit.number;
}

/// The memory of a thread for a tile.
template <abi::Features F>
struct FusedMemory {
    float* color = nullptr;
    FromPoint<F, float> visible;  ///< objects visible through the tile, with lists_by_tile
    // Only in exact mode:
    CommonLists candidates;                       ///< objects visible through the tile
    FilteredObjects<Origin::any> from_far;        ///< for reflected rays outside the plan's origins
    LightObjects<F, float>* occluders = nullptr;  ///< for hits outside the plan's origins, by
                                                  ///< light; only of lights that send no rays
    std::size_t bytes = 0;

    /// With a null `scratch`, only `bytes` is valid.
    FusedMemory(void* scratch, const abi::SceneView<float>& scene)
    {
        Arena arena(scratch);
        color = arena.take<float>(tile_elements);
        if constexpr (lists_by_tile<F>)
            take_objects<F>(arena, visible, scene);
        if constexpr (F.exact)
            take_exact(arena, scene);
        bytes = arena.used();
    }

private:
    void take_exact(Arena& arena, const abi::SceneView<float>& scene)
    {
        candidates.take(arena, scene);
        if (scene.rules.max_depth > 0)
            take_objects<F>(arena, from_far, scene);
        const auto lights = static_cast<std::size_t>(scene.lighting.lights.count);
        occluders = arena.take<LightObjects<F, float>>(lights);
        LightObjects<F, float> measured;
        for (std::size_t i = 0; i < lights; ++i)
            if (!scene.lighting.lights.data[i].sends_rays)
                take_occluders<F, float>(arena, color != nullptr ? occluders[i] : measured, scene,
                                         scene.lighting.lights.data[i]);
    }
};

/// The state shared by the packets of a tile.
template <abi::Features F>
struct FusedTile {
    const abi::SceneView<float>& scene;
    const FramePlan<F>& plan;
    FusedMemory<F>& memory;
    abi::RayCounts& counts;
    float camera_origin[3];
    float camera_t_min;
};

template <Generation G, abi::Features F>
inline float least_t(const FusedTile<F>& tile)
{
    return G == Generation::camera ? tile.camera_t_min : tile.scene.rules.secondary_t_min;
}

template <Generation G, abi::Features F>
inline RayPacket<float> rays_of(const FusedTile<F>& tile, const PathState<F>& path)
{
    const vreal<float> t_min(least_t<G>(tile));
    if constexpr (G == Generation::camera)
        return {broadcast(tile.camera_origin), path.dir, path.dir2, t_min};
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

/// The surfaces that rays start on, which their search skips. Only active lanes count.
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

/// The ball around the points of some lanes.
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
    // It also contains origins of shadow rays, which are offset from the points.
    return origins_in(low, high);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
