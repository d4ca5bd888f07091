#pragma once

#include "kernels/block_ray.hpp"

// One ray against those spheres of a block that it does not miss for sure.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The spheres in whole packets, though a packet may have more lanes than a block has spheres.
struct BlockLanes {
    static constexpr int step = lanes<float> < abi::node_width ? lanes<float> : abi::node_width;

    static vreal<float> load_lanes(const float* from)
    {
        if constexpr (lanes<float> <= abi::node_width) {
            return load(from);
        } else {
            alignas(64) float values[lanes<float>];
            __builtin_memcpy(values, from, sizeof(float) * abi::node_width);
            for (int lane = abi::node_width; lane < lanes<float>; ++lane)
                values[lane] = values[0];
            return load(values);
        }
    }
};

/// The test of the spheres from `first` on of a block.
inline SphereTest test_of(const RayGroup<float>& group, const RayPacket<float>& rays,
                          const abi::SphereBlock<float>& block, int first)
{
    const Vec3v<float> center{BlockLanes::load_lanes(block.center[0] + first),
                              BlockLanes::load_lanes(block.center[1] + first),
                              BlockLanes::load_lanes(block.center[2] + first)};
    const vreal<float> radius = BlockLanes::load_lanes(block.radius + first);
    return {rays.org - center, signed_square<float>(radius), leaf_bounds(group, radius)};
}

/// The spheres of `near` that a group's ray does not start on.
inline std::uint32_t without_own(const RayGroup<float>& group, int ray,
                                 const SphereLeaf<float>& leaf, std::uint32_t near)
{
    for (std::uint32_t left = near; left != 0; left &= left - 1)
        if (leaf.surface_of(__builtin_ctz(left)) == group.own[ray])
            near &= ~(1u << __builtin_ctz(left));
    return near;
}

/// As keep_sure() and keep_doubt() do with a packet of rays.
inline void keep_sure(RayGroup<float>& group, int ray, float low, float high, std::int32_t surface)
{
    const bool first = high < group.t[ray];
    const float behind = first ? group.t_low[ray] : low;
    if (behind < group.other[ray])
        group.other[ray] = behind;
    if (first) {
        group.t[ray] = high;
        group.t_low[ray] = low;
        group.surface[ray] = surface;
    }
}
inline void keep_doubt(RayGroup<float>& group, int ray, float low)
{
    if (!(low >= group.other[ray]))
        group.other[ray] = low == low ? low : -__builtin_inff();
}

/// Keeps the hits of a ray on the spheres of `near`.
[[gnu::noinline]] inline void keep_near_spheres(RayGroup<float>& group, int ray,
                                                const SphereLeaf<float>& leaf, std::uint32_t near)
{
    near = without_own(group, ray, leaf, near);
    const RayPacket<float> rays = broadcast_ray(group, ray);
    const RayScale scale(rays, vreal<float>(group.inverse[ray]));
    for (int first = 0; first < abi::node_width && near != 0; first += BlockLanes::step) {
        const std::uint32_t active = near >> first & ((1u << BlockLanes::step) - 1u);
        if (active == 0)
            continue;
        const SphereTest test = test_of(group, rays, leaf.block, first);
        const SphereApproach at = approach(test.w, test.bounds.outer2, rays);
        // One hit for all lanes, each of a sphere of its own: the first that counts, and from where
        // on in doubt.
        HitPacket<float> hit = no_hit<float>(__builtin_inff());
        keep_near_sphere(hit, test, {at.moment2, from_bits<float>(active)}, rays, scale, 0);
        alignas(64) float low[lanes<float>];
        alignas(64) float high[lanes<float>];
        alignas(64) float doubt[lanes<float>];
        store(low, hit.t_low);
        store(high, hit.t);
        store(doubt, hit.other);
        const std::uint32_t hits =
            bits(int_equal(hit.surface, vint<float>(lane_int<float>{0}))) & active;
        for (std::uint32_t left = active; left != 0; left &= left - 1) {
            const int lane = __builtin_ctz(left);
            if ((hits >> lane & 1u) != 0)
                keep_sure(group, ray, low[lane], high[lane], leaf.surface_of(first + lane));
            else if (doubt[lane] < __builtin_inff())
                keep_doubt(group, ray, doubt[lane]);
        }
    }
}

/// A bit for each sphere of `near` that is in the way of a ray up to its end for sure; rays that
/// others may be in the way of are marked.
[[gnu::noinline]] inline std::uint32_t blocking_spheres(RayGroup<float>& group, int ray,
                                                        const SphereLeaf<float>& leaf,
                                                        std::uint32_t near)
{
    near = without_own(group, ray, leaf, near);
    const RayPacket<float> rays = broadcast_ray(group, ray);
    const RayScale scale(rays, vreal<float>(group.inverse[ray]));
    std::uint32_t blocking = 0;
    for (int first = 0; first < abi::node_width && near != 0; first += BlockLanes::step) {
        const std::uint32_t active = near >> first & ((1u << BlockLanes::step) - 1u);
        if (active == 0)
            continue;
        const SphereTest test = test_of(group, rays, leaf.block, first);
        const SphereApproach at = approach(test.w, test.bounds.outer2, rays);
        const Occlusion occlusion = occludes(test, {at.moment2, from_bits<float>(active)}, rays,
                                             scale, vreal<float>(group.t[ray]));
        blocking |= occlusion.blocked << first;
        if (occlusion.unsure != 0)
            group.unsure[ray / cell_rays] |= static_cast<std::uint16_t>(1u << ray % cell_rays);
    }
    return blocking;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
