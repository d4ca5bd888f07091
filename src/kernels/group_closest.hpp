#pragma once

#include "kernels/tree_closest.hpp"
#include "kernels/walk_lists.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Tests listed rays for their closest hits.
template <abi::Features F, class Real>
struct ClosestOfListed {
    const abi::BvhView<Real>& tree;
    const SlabRays& slabs;
    RayGroup<Real>& group;

    void leaf(std::uint32_t child, int ray) const
    {
        closest_of_leaf<F>(tree, group, ray, BlockRay<Real>(group, ray), child);
    }
    void lone(std::uint32_t child, int ray) const
    {
        closest_of_ray<F>(tree, slabs, group, ray, child);
    }
};

/// The active rays of cells that share no way.
template <abi::Features F, class Real>
[[gnu::noinline]] void closest_of_others(const abi::BvhView<Real>& tree, RayGroup<Real>& group,
                                         std::uint32_t cells)
{
    SlabRays slabs;
    walk_in_lists(tree, slabs, group, cells, ClosestOfListed<F, Real>{tree, slabs, group});
}

/// Brings the t and surface of a group's active rays down to their first hit in the hierarchy,
/// where that comes before.
template <abi::Features F, class Real>
[[gnu::noinline]] void closest_in_tree(const abi::BvhView<Real>& tree, RayGroup<Real>& group)
{
    const PartScope part(abi::Part::boxes);
    if constexpr (F.exact)
        bound_origins(group, tree);
    CellBounds bounds;
    bound_cells(bounds, group, tree, tree.spread);
    if (bounds.coherent != 0)
        closest_of_cells<F>(tree, group, bounds);
    const std::uint32_t others = active_cells(group) & ~bounds.coherent;
    if (others != 0)
        closest_of_others<F>(tree, group, others);
}

/// The same among all objects of a scene, lists first: what stands in them is large.
template <abi::Features F, class Objects, class Real>
inline void closest_of_group(const abi::GeometryView<Real>& scene, const Objects& lists,
                             RayGroup<Real>& group)
{
    for (int first = 0; first < group_rays; first += lanes<Real>) {
        if (active_lanes(group, first) == 0)
            continue;
        tell_live(active_lanes(group, first));
        HitPacket<Real> hit = load_hits(group, first);
        closest_hit<F>(hit, lists, load_rays(group, first), own_of(group, first));
        store_hits<F>(group, first, hit);
    }
    if (!scene.tree.empty())
        closest_in_tree<abi::tree_features(F)>(scene.tree, group);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
