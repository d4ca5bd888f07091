#pragma once

#include "kernels/block_ray.hpp"
#include "kernels/cell_rays.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// The blocker of opaque shadows and of occlusion: each ends the rays it blocks.
struct EndsRays {
    std::uint32_t operator()(std::int32_t, int, std::uint32_t blocked) const
    {
        return blocked;
    }
};

/// Takes lanes of a packet out of the active ones.
template <class Real>
inline void finish_lanes(RayGroup<Real>& group, int first, std::uint32_t done)
{
    group.active[first / cell_rays] &= static_cast<std::uint16_t>(~(done << first % cell_rays));
}

/// A single ray of a group meets what blocks it; whether it goes on behind that.
template <class Real, class Blocker>
inline bool goes_behind(RayGroup<Real>& group, int ray, std::int32_t surface,
                        const Blocker& blocker)
{
    const int first = ray / lanes<Real> * lanes<Real>;
    finish_lanes(group, first, blocker(surface, first, 1u << (ray - first)));
    return is_active(group, ray);
}

template <class Real, class Blocker>
inline bool goes_behind_quadrics(RayGroup<Real>& group, int ray, bool closed,
                                 const abi::QuadricRecord<Real>* quadric, int count,
                                 const Blocker& blocker)
{
    const PartScope part(abi::Part::quadrics);
    tell_live(1);
    const RayPacket<Real> rays = broadcast_ray(group, ray);
    const vint<Real> own(group.surface[ray]);
    const Reach<Real> reach{vreal<Real>(group.t[ray]), closed};
    for (int i = 0; i < count; ++i) {
        count_tests(abi::Primitive::quadric, 1);
        if (quadric_blocks(reach, quadric[i], rays, own) != 0 &&
            !goes_behind(group, ray, quadric[i].surface, blocker))
            return false;
    }
    return true;
}

/// The ray, which is `alone`, against one leaf.
template <abi::Features F, class Real, class Blocker>
inline bool goes_behind_leaf(const abi::BvhView<Real>& tree, RayGroup<Real>& group, int ray,
                             const BlockRay<Real>& alone, bool closed, std::uint32_t child,
                             const Blocker& blocker)
{
    if (F.quadrics && abi::is_quadric_leaf(child))
        return goes_behind_quadrics(group, ray, closed, tree.quadrics + abi::first_quadric(child),
                                    abi::quadric_count(child), blocker);
    const PartScope part(abi::Part::spheres);
    const SphereLeaf<Real> leaf = sphere_leaf(tree, child);
    count_block_tests(leaf.block);
    std::uint32_t blocking = alone.blocked_by(leaf.block, group.t[ray], closed);
    for (; blocking != 0; blocking &= blocking - 1) {
        const std::int32_t surface = leaf.surface_of(__builtin_ctz(blocking));
        if (surface != group.surface[ray] && !goes_behind(group, ray, surface, blocker))
            return false;
    }
    return true;
}

/// The ray against all below `child`.
template <abi::Features F, class Real, class Blocker>
inline void blockers_of_ray(const abi::BvhView<Real>& tree, const SlabRays& slabs,
                            RayGroup<Real>& group, int ray, std::uint32_t child, bool closed,
                            const Blocker& blocker)
{
    const BlockRay<Real> alone(group, ray);
    SlabRay slab = slab_ray(slabs, group, ray);
    walk_ray(tree, child, slab, [&](std::uint32_t leaf) {
        return goes_behind_leaf<F>(tree, group, ray, alone, closed, leaf, blocker);
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
