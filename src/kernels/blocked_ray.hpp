#pragma once

#include "kernels/cell_rays.hpp"
#include "kernels/near_spheres.hpp"

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

/// What a quadric of a leaf does to a packet until t_end.
template <abi::Features F, class Real>
inline Occlusion leaf_quadric_occludes(const abi::BvhView<Real>& tree, int number,
                                       const RayGroup<Real>& group, const RayPacket<Real>& rays,
                                       const vreal<Real>& t_end, const vint<Real>& own, bool closed)
{
    if constexpr (F.exact) {
        const abi::QuadricRecord<float>& record = tree.quadrics[number];
        const abi::QuadricRecord<double>& wide =
            tree.shapes->quadrics[tree.shapes->index[record.surface].record];
        const std::uint32_t active =
            may_hit<false>(leaf_filter(record, wide, group), rays, RayScale(rays), t_end);
        return active == 0 ? Occlusion{} : occludes(wide, rays, t_end, own, active);
    } else {
        return {quadric_blocks(Reach<Real>{t_end, closed}, leaf_quadric(tree, number), rays, own),
                0};
    }
}

template <abi::Features F, class Real, class Blocker>
inline bool goes_behind_quadrics(const abi::BvhView<Real>& tree, RayGroup<Real>& group, int ray,
                                 bool closed, std::uint32_t child, const Blocker& blocker)
{
    const PartScope part(abi::Part::quadrics);
    tell_live(1);
    const RayPacket<Real> rays = broadcast_ray(group, ray);
    const vint<Real> own(group.own[ray]);
    for (int i = 0; i < abi::quadric_count(child); ++i) {
        const int number = abi::first_quadric(child) + i;
        count_tests(abi::Primitive::quadric, 1);
        const Occlusion occlusion = leaf_quadric_occludes<F>(
            tree, number, group, rays, vreal<Real>(group.t[ray]), own, closed);
        if (occlusion.unsure != 0) {
            keep_noted_of_ray(ray, occlusion.unsure);
            group.unsure[ray / cell_rays] |= static_cast<std::uint16_t>(1u << ray % cell_rays);
        }
        if (occlusion.blocked != 0 &&
            !goes_behind(group, ray, leaf_quadric(tree, number).surface, blocker))
            return false;
    }
    return true;
}

/// A bit for each sphere of a leaf that is in the way of a ray, which is `alone`.
template <abi::Features F, class Real>
inline std::uint32_t blocking_spheres_of(RayGroup<Real>& group, int ray,
                                         const BlockRay<Real>& alone, const SphereLeaf<Real>& leaf,
                                         bool closed)
{
    if constexpr (F.exact) {
        const std::uint32_t near = alone.near(leaf.block, group);
        return near == 0 ? 0 : blocking_spheres(group, ray, leaf, near);
    } else {
        return alone.blocked_by(leaf.block, group.t[ray], closed);
    }
}

/// The ray, which is `alone`, against one leaf.
template <abi::Features F, class Real, class Blocker>
inline bool goes_behind_leaf(const abi::BvhView<Real>& tree, RayGroup<Real>& group, int ray,
                             const BlockRay<Real>& alone, bool closed, std::uint32_t child,
                             const Blocker& blocker)
{
    if (F.quadrics && abi::is_quadric_leaf(child))
        return goes_behind_quadrics<F>(tree, group, ray, closed, child, blocker);
    const PartScope part(abi::Part::spheres);
    abi::SphereBlock<Real> room;
    const SphereLeaf<Real> leaf = sphere_leaf(tree, child, room);
    count_block_tests(leaf.block);
    std::uint32_t blocking = blocking_spheres_of<F>(group, ray, alone, leaf, closed);
    for (; blocking != 0; blocking &= blocking - 1) {
        const std::int32_t surface = leaf.surface_of(__builtin_ctz(blocking));
        if (surface != group.own[ray] && !goes_behind(group, ray, surface, blocker))
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
