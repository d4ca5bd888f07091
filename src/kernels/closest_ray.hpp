#pragma once

#include "kernels/cell_rays.hpp"
#include "kernels/closest.hpp"

// The closest hit of a single ray in the hierarchy. Spheres of a block are tested side by side,
// by the operations that test one sphere against a packet of rays, so with the same bits.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// One ray in every lane.
template <class Real>
inline RayPacket<Real> broadcast_ray(const RayGroup<Real>& group, int ray)
{
    const auto all3 = [ray](const Real(&from)[3][group_rays]) {
        return Vec3v<Real>{vreal<Real>(from[0][ray]), vreal<Real>(from[1][ray]),
                           vreal<Real>(from[2][ray])};
    };
    RayPacket<Real> rays;
    rays.org = all3(group.org);
    rays.dir = all3(group.dir);
    rays.dir2 = dot(rays.dir, rays.dir);
    rays.t_min = vreal<Real>(group.t_min[ray]);
    return rays;
}

/// The spheres of a block from `first`, one a lane; with more lanes than spheres the others hold
/// anything.
template <class Real>
inline Quadratic<Real> quadratics_of(const abi::SphereBlock<Real>& block, int first,
                                     const RayPacket<Real>& rays)
{
    const Vec3v<Real> center{load(block.center[0] + first), load(block.center[1] + first),
                             load(block.center[2] + first)};
    const Vec3v<Real> o = rays.org - center;
    const vreal<Real> radius2 = load(block.radius2 + first);
    return sphere_quadratic<Real>(rays, o, radius2, sphere_constant<Real>(o, radius2));
}

/// Lanes that hold spheres of a block.
template <class Real>
inline constexpr std::uint32_t block_lanes = lanes<Real> <= abi::node_width
                                                 ? all_lanes<Real>
                                                 : (1u << abi::node_width) - 1u;

/// Of the chosen lanes' hits the closest, if it comes before that of the ray.
template <class Real>
inline void keep_closest_lane(RayGroup<Real>& group, int ray, const HitPacket<Real>& hit,
                              std::uint32_t chosen)
{
    alignas(64) Real t[lanes<Real>];
    alignas(64) lane_int<Real> surface[lanes<Real>];
    store(t, hit.t);
    store(surface, hit.surface);
    for (; chosen != 0; chosen &= chosen - 1) {
        const int lane = __builtin_ctz(chosen);
        if (t[lane] < group.t[ray] ||
            (t[lane] == group.t[ray] && surface[lane] < group.surface[ray])) {
            group.t[ray] = t[lane];
            group.surface[ray] = surface[lane];
        }
    }
}

template <class Real>
inline void closest_of_block(RayGroup<Real>& group, int ray, const RayPacket<Real>& rays,
                             const abi::SphereBlock<Real>& block)
{
    const PartScope part(abi::Part::spheres);
    for (int first = 0; first < abi::node_width; first += lanes<Real>) {
        count_block_tests(block, first);
        const Quadratic<Real> quadratic = quadratics_of(block, first, rays);
        const auto active = may_hit(quadratic) & from_bits<Real>(block_lanes<Real>);
        if (none(active))
            continue;
        HitPacket<Real> hit = no_hit<Real>(static_cast<Real>(__builtin_inf()));
        keep_first_root<Real>(hit, quadratic, active, rays.t_min, 0);
        const std::uint32_t found =
            bits(int_equal(hit.surface, vint<Real>(lane_int<Real>(0)))) & bits(active);
        if (found == 0)
            continue;
        hit.surface = load(block.surface + first);
        keep_closest_lane(group, ray, hit, found);
    }
}

template <class Real>
inline void closest_of_quadrics(RayGroup<Real>& group, int ray, const RayPacket<Real>& rays,
                                const abi::QuadricRecord<Real>* quadrics, int count)
{
    const PartScope part(abi::Part::quadrics);
    tell_live(1);
    count_tests(abi::Primitive::quadric, count);
    HitPacket<Real> hit{vreal<Real>(group.t[ray]), vint<Real>(group.surface[ray])};
    for (int i = 0; i < count; ++i)
        keep_quadric(hit, quadrics[i], rays);
    alignas(64) lane_int<Real> surface[lanes<Real>];
    store(surface, hit.surface);
    group.t[ray] = first_lane<Real>(hit.t);
    group.surface[ray] = surface[0];
}

/// The ray against one leaf.
template <abi::Features F, class Real>
inline void closest_of_leaf(const abi::BvhView<Real>& tree, RayGroup<Real>& group, int ray,
                            const RayPacket<Real>& rays, std::uint32_t child)
{
    if (F.quadrics && abi::is_quadric_leaf(child))
        closest_of_quadrics(group, ray, rays, tree.quadrics + abi::first_quadric(child),
                            abi::quadric_count(child));
    else
        closest_of_block(group, ray, rays, tree.blocks[child & abi::block_mask]);
}

/// The ray against all below `child`.
template <abi::Features F, class Real>
inline void closest_of_ray(const abi::BvhView<Real>& tree, const SlabRays& slabs,
                           RayGroup<Real>& group, int ray, std::uint32_t child)
{
    const RayPacket<Real> rays = broadcast_ray(group, ray);
    SlabRay slab = slab_ray(slabs, group, ray);
    walk_ray(tree, child, slab, [&](std::uint32_t leaf) {
        closest_of_leaf<F>(tree, group, ray, rays, leaf);
        slab.t_max = float_above(group.t[ray]);
        return true;
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
