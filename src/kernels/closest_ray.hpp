#pragma once

#include "kernels/cell_rays.hpp"
#include "kernels/closest.hpp"
#include "kernels/near_spheres.hpp"

// The closest hit of a single ray in the hierarchy.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Takes the closest hit on a leaf's spheres, if it comes before that of the ray.
template <abi::Features F, class Real>
inline void closest_of_spheres(RayGroup<Real>& group, int ray, const BlockRay<Real>& alone,
                               const SphereLeaf<Real>& leaf)
{
    const PartScope part(abi::Part::spheres);
    count_block_tests(leaf.block);
    if constexpr (F.exact) {
        const std::uint32_t near = alone.near(leaf.block, group);
        if (near != 0)
            keep_near_spheres(group, ray, leaf, near);
    } else {
        Real t[abi::node_width];
        std::uint32_t met = alone.first_roots(leaf.block, group.t[ray], t);
        for (; met != 0; met &= met - 1) {
            const int slot = __builtin_ctz(met);
            const std::int32_t surface = leaf.surface_of(slot);
            if (surface == group.own[ray])
                continue;
            if (t[slot] < group.t[ray] ||
                (t[slot] == group.t[ray] && surface < group.surface[ray])) {
                group.t[ray] = t[slot];
                group.surface[ray] = surface;
            }
        }
    }
}

template <abi::Features F, class Real>
inline void closest_of_quadrics(const abi::BvhView<Real>& tree, RayGroup<Real>& group, int ray,
                                int begin, int count)
{
    const PartScope part(abi::Part::quadrics);
    tell_live(1);
    count_tests(abi::Primitive::quadric, count);
    const RayPacket<Real> rays = broadcast_ray(group, ray);
    load_rival_of_ray<Real>(ray);
    HitPacket<Real> hit{vreal<Real>(group.t[ray]), vint<Real>(group.surface[ray]),
                        vreal<Real>(group.t_low[ray]), vreal<Real>(group.other[ray])};
    const OwnSurface own{vint<Real>(group.own[ray])};
    for (int i = 0; i < count; ++i)
        keep_leaf_quadric<F>(hit, tree, begin + i, group, rays, own);
    alignas(64) lane_int<Real> surface[lanes<Real>];
    store(surface, hit.surface);
    group.t[ray] = first_lane<Real>(hit.t);
    group.surface[ray] = surface[0];
    if constexpr (F.exact) {
        group.t_low[ray] = first_lane<Real>(hit.t_low);
        group.other[ray] = first_lane<Real>(hit.other);
        store_rival_of_ray<Real>(ray);
    }
}

/// The ray, which is `alone`, against one leaf.
template <abi::Features F, class Real>
inline void closest_of_leaf(const abi::BvhView<Real>& tree, RayGroup<Real>& group, int ray,
                            const BlockRay<Real>& alone, std::uint32_t child)
{
    if (F.quadrics && abi::is_quadric_leaf(child))
        return closest_of_quadrics<F>(tree, group, ray, abi::first_quadric(child),
                                      abi::quadric_count(child));
    abi::SphereBlock<Real> room;
    closest_of_spheres<F>(group, ray, alone, sphere_leaf(tree, child, room));
}

/// The ray against all below `child`.
template <abi::Features F, class Real>
inline void closest_of_ray(const abi::BvhView<Real>& tree, const SlabRays& slabs,
                           RayGroup<Real>& group, int ray, std::uint32_t child)
{
    const BlockRay<Real> alone(group, ray);
    SlabRay slab = slab_ray(slabs, group, ray);
    walk_ray(tree, child, slab, [&](std::uint32_t leaf) {
        closest_of_leaf<F>(tree, group, ray, alone, leaf);
        slab.t_max = float_above(group.t[ray]);
        return true;
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
