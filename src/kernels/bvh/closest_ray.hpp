#pragma once

#include "kernels/bvh/cell_rays.hpp"
#include "kernels/bvh/near_spheres.hpp"
#include "kernels/lists/closest.hpp"

// The closest hit of a single ray in the BVH.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Keeps the closest hit with a leaf's spheres, if it is closer than the ray's hit.
template <abi::Features F, class Real>
inline void closest_of_spheres(RayBundle<Real>& bundle, int ray, const BlockRay<Real>& alone,
                               const SphereLeaf<Real>& leaf, const abi::ShapesView& shapes)
{
    const StepScope step(abi::Step::spheres);
    count_block_tests(leaf.block);
    if constexpr (F.exact) {
        const std::uint32_t near = alone.near(leaf.block, bundle, ray);
        if (near != 0)
            keep_near_spheres(bundle, ray, leaf, shapes, near);
    } else {
        Real t[abi::node_width];
        std::uint32_t met = alone.first_roots(leaf.block, bundle.t[ray], t);
        for (; met != 0; met &= met - 1) {
            const int slot = __builtin_ctz(met);
            const std::int32_t surface = leaf.surface_of(slot);
            if (surface == bundle.own[ray])
                continue;
            if (t[slot] < bundle.t[ray] ||
                (t[slot] == bundle.t[ray] && surface < bundle.surface[ray])) {
                bundle.t[ray] = t[slot];
                bundle.surface[ray] = surface;
            }
        }
    }
}

/// Keeps the closest hits of a packet with one object of a run.
template <abi::Features F, class Real, class Own>
inline void keep_of_run(HitPacket<Real>& hit, const abi::BvhView<Real>& bvh, int number,
                        const RayBundle<Real>& bundle, const RayPacket<Real>& rays, const Own& own)
{
    with_object_of_run(bvh, number, [&](const auto& record, const auto& shape) {
        if constexpr (F.exact)
            keep_certain<Origin::any>(hit, leaf_filter(number, record, shape, bundle), rays,
                                      RayScale(rays), own);
        else
            keep_closest(hit, record, rays, own);
    });
}

template <abi::Features F, class Real>
[[gnu::noinline]] void closest_of_run(const abi::BvhView<Real>& bvh, RayBundle<Real>& bundle,
                                      int ray, int begin, int count)
{
    const abi::Primitive kind = primitive_of_run(bvh, begin);
    const StepScope step(step_of(kind));
    record_live(1);
    count_tests(kind, count);
    const RayPacket<Real> rays = broadcast_ray(bundle, ray);
    load_rival_of_ray<Real>(ray);
    HitPacket<Real> hit{vreal<Real>(bundle.t[ray]), vint<Real>(bundle.surface[ray]),
                        vreal<Real>(bundle.t_low[ray]), vreal<Real>(bundle.other[ray])};
    const OwnSurface own{vint<Real>(bundle.own[ray])};
    for (int i = 0; i < count; ++i)
        keep_of_run<F>(hit, bvh, begin + i, bundle, rays, own);
    alignas(64) lane_int<Real> surface[lanes<Real>];
    store(surface, hit.surface);
    bundle.t[ray] = first_lane<Real>(hit.t);
    bundle.surface[ray] = surface[0];
    if constexpr (F.exact) {
        bundle.t_low[ray] = first_lane<Real>(hit.t_low);
        bundle.other[ray] = first_lane<Real>(hit.other);
        store_rival_of_ray<Real>(ray);
    }
}

/// Tests a ray, which `alone` holds too, against one leaf.
template <abi::Features F, class Real>
inline void closest_of_leaf(const abi::BvhView<Real>& bvh, RayBundle<Real>& bundle, int ray,
                            const BlockRay<Real>& alone, std::uint32_t child)
{
    if (F.quadrics && abi::is_run(child))
        return closest_of_run<F>(bvh, bundle, ray, abi::first_of_run(child), abi::run_count(child));
    abi::SphereBlock<Real> gathered;
    closest_of_spheres<F>(bundle, ray, alone, sphere_leaf(bvh, child, gathered), *bvh.shapes);
}

/// Tests a ray against everything below `child`.
template <abi::Features F, class Real>
inline void closest_of_ray(const abi::BvhView<Real>& bvh, const SlabRays& slabs,
                           RayBundle<Real>& bundle, int ray, std::uint32_t child)
{
    const BlockRay<Real> alone(bundle, ray);
    SlabRay slab = slab_ray(slabs, bundle, ray);
    walk_ray(bvh, child, slab, [&](std::uint32_t leaf) {
        closest_of_leaf<F>(bvh, bundle, ray, alone, leaf);
        slab.t_max = float_above(bundle.t[ray]);
        return true;
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
