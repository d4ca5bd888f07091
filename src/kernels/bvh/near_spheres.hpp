#pragma once

#include "kernels/bvh/block_ray.hpp"

// Tests one ray against the spheres of a block that it does not certainly miss, side by side.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// One ray of a bundle, in every lane.
struct LoneRay {
    RayPacket<float> rays;
    RayScale scale;

    LoneRay(const RayBundle<float>& bundle, int ray)
        : rays(broadcast_ray(bundle, ray)), scale(rays, vreal<float>(bundle.inverse[ray]))
    {
    }
};

/// The test of a ray and the spheres of a block from `first` on.
template <class Block>
inline SphereTest test_of(const LoneRay& ray, const RayBundle<float>& bundle, const Block& block,
                          int first)
{
    const Vec3v<float> center{load_of_block(block.center[0], first),
                              load_of_block(block.center[1], first),
                              load_of_block(block.center[2], first)};
    const vreal<float> radius = load_of_block(block.radius, first);
    return {ray.rays.org - center, radius * radius, leaf_bounds(bundle, radius)};
}

/// keep_sure() and keep_doubt() of filter.hpp, for one ray of a bundle.
inline void keep_sure(RayBundle<float>& bundle, int ray, float low, float high,
                      std::int32_t surface)
{
    const bool first = high < bundle.t[ray];
    const float behind = first ? bundle.t_low[ray] : low;
    if (behind < bundle.other[ray]) {
        bundle.other[ray] = behind;
        note_rival_of_ray(ray, first ? bundle.surface[ray] : surface);
    }
    if (first) {
        bundle.t[ray] = high;
        bundle.t_low[ray] = low;
        bundle.surface[ray] = surface;
    }
}
inline void keep_doubt(RayBundle<float>& bundle, int ray, float low, std::int32_t rival)
{
    if (low >= bundle.other[ray])
        return;
    bundle.other[ray] = low == low ? low : -__builtin_inff();
    note_rival_of_ray(ray, rival);
}

/// Keeps the hit with a sphere that error bounds could not decide, computed in double. With
/// `at_end` the hit exists but may be before t_min; else it may not exist.
inline void keep_by_double(RayBundle<float>& bundle, int ray, const abi::SphereShape& sphere,
                           float low, std::int32_t surface, bool at_end)
{
    const FirstHit hit = first_hit(sphere, wide_ray(bundle, ray));
    if (hit.there == InDouble::yes)
        keep_sure(bundle, ray, hit.low, hit.high, surface);
    else if (hit.there == InDouble::undecided)
        keep_doubt(bundle, ray, low, rival_in_doubt(at_end));
}

/// Where a ray may hit spheres first beyond its t_min, and not behind its hit so far.
struct BlockHits {
    alignas(64) float low[lanes<float>];
    alignas(64) float high[lanes<float>];
    std::uint32_t may;     ///< lanes that it may hit
    std::uint32_t counts;  ///< lanes that it certainly hits there
    std::uint32_t sure;    ///< lanes whose sphere its line certainly hits
};

inline void find_hits(BlockHits& hits, const LoneRay& ray, const SphereTest& test,
                      const SphereApproach& near, float t_max)
{
    const SphereCrossing at = crossing(test, near, ray.rays, ray.scale);
    const vreal<float>& t_min = ray.rays.t_min;
    hits.sure = bits(at.sure);
    const FirstRoot first = first_root_beyond(at.roots, t_min);
    vreal<float> low = first.low;
    hits.may = hits.sure & ~first.none;
    const std::uint32_t band = near.near & ~hits.sure;
    if (band != 0) {
        const vreal<float> error = band_error(test, at, ray.scale);
        hits.may |= band & ~bits(at.middle + error < t_min);
        low = select(at.sure, low, at.middle - error);
    }
    hits.may &= ~bits(low > vreal<float>(t_max));
    if (hits.may == 0)
        return;
    hits.counts = bits(first.counts) & hits.sure;
    store(hits.low, low);
    store(hits.high, first.high);
}

/// `near` without the sphere that the ray starts on and without unused slots, which far away look
/// like spheres.
inline std::uint32_t others_of(std::uint32_t near, const SphereLeaf<float>& leaf, std::int32_t own)
{
    for (std::uint32_t left = near; left != 0; left &= left - 1) {
        const std::int32_t surface = leaf.surface_of(__builtin_ctz(left));
        if (surface == own || surface < 0)
            near &= ~(left & -left);
    }
    return near;
}

/// Keeps the hits of a ray with the spheres of `near`. Hits that error bounds cannot decide are
/// computed in double.
[[gnu::noinline]] inline void keep_near_spheres(RayBundle<float>& bundle, int ray,
                                                const SphereLeaf<float>& leaf,
                                                const abi::ShapesView& shapes, std::uint32_t near)
{
    near = others_of(near, leaf, bundle.own[ray]);
    if (near == 0)
        return;
    const LoneRay lone(bundle, ray);
    for (int first = 0; first < abi::node_width; first += lanes<float>) {
        const std::uint32_t some = near >> first & all_lanes<float>;
        if (some == 0)
            continue;
        const SphereTest test = test_of(lone, bundle, leaf.block, first);
        BlockHits hits;
        find_hits(hits, lone, test, {moment2_of(test.w, lone.rays), some}, bundle.t[ray]);
        for (; hits.may != 0; hits.may &= hits.may - 1) {
            const int lane = __builtin_ctz(hits.may);
            const std::int32_t surface = leaf.surface_of(first + lane);
            if ((hits.counts >> lane & 1) != 0)
                keep_sure(bundle, ray, hits.low[lane], hits.high[lane], surface);
            else
                keep_by_double(bundle, ray, sphere_of(shapes, surface), hits.low[lane], surface,
                               (hits.sure >> lane & 1) != 0);
        }
    }
}

/// Decides in double the lanes of `unsure`, whose spheres may occlude a ray; `surface` are the
/// surfaces of all lanes. Returns the lanes that do.
inline std::uint32_t blocked_by_double(RayBundle<float>& bundle, int ray,
                                       const abi::ShapesView& shapes, const std::int32_t* surface,
                                       std::uint32_t unsure)
{
    std::uint32_t blocked = 0;
    for (; unsure != 0; unsure &= unsure - 1) {
        const std::uint32_t lane = unsure & -unsure;
        const InDouble blocks = is_in_the_way(sphere_of(shapes, surface[__builtin_ctz(unsure)]),
                                              wide_ray(bundle, ray), bundle.t[ray]);
        if (blocks == InDouble::yes)
            blocked |= lane;
        else if (blocks == InDouble::undecided)
            doubt_ray(bundle, ray, lane);
    }
    return blocked;
}

/// A bit for each sphere of `near` that certainly occludes a ray up to its end. The ray is marked
/// as unsure if others may.
[[gnu::noinline]] inline std::uint32_t blocking_spheres(RayBundle<float>& bundle, int ray,
                                                        const SphereLeaf<float>& leaf,
                                                        const abi::ShapesView& shapes,
                                                        std::uint32_t near)
{
    near = others_of(near, leaf, bundle.own[ray]);
    if (near == 0)
        return 0;
    // Rays that end at a sphere are hardly ever certain about it.
    for (std::uint32_t left = near; left != 0; left &= left - 1)
        fetch_sphere(shapes, leaf.surface_of(__builtin_ctz(left)));
    const LoneRay lone(bundle, ray);
    std::uint32_t blocking = 0;
    for (int first = 0; first < abi::node_width; first += lanes<float>) {
        const std::uint32_t some = near >> first & all_lanes<float>;
        if (some == 0)
            continue;
        const SphereTest test = test_of(lone, bundle, leaf.block, first);
        const Occlusion occlusion = occludes(test, {moment2_of(test.w, lone.rays), some}, lone.rays,
                                             lone.scale, vreal<float>(bundle.t[ray]));
        const std::uint32_t blocked =
            occlusion.blocked |
            blocked_by_double(bundle, ray, shapes, leaf.surface + first, occlusion.unsure);
        blocking |= blocked << first;
    }
    return blocking;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
