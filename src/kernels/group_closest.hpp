#pragma once

#include "kernels/closest_ray.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Brings the t and surface of a group's active rays down to their first hit in the hierarchy,
/// where that comes before: cells of rays that run together as beams, the others ray by ray.
template <abi::Features F, class Real>
inline void closest_in_tree(const abi::BvhView<Real>& tree, RayGroup<Real>& group)
{
    CellBounds bounds;
    bound_cells(bounds, group, tree.extent, tree.slack);
    if (bounds.coherent != 0)
        closest_of_cells<F>(tree, group, bounds);
    for (int cell = 0; cell < group_cells; ++cell) {
        if (bounds.coherent >> cell & 1u)
            continue;
        for (std::uint32_t left = group.active[cell]; left != 0; left &= left - 1)
            closest_of_ray<F>(tree, group, cell * cell_rays + __builtin_ctz(left));
    }
}

/// The same among all objects of a scene, lists first: what stands in them is large.
template <abi::Features F, class Objects, class Real>
inline void closest_of_group(const abi::SceneView<Real>& scene, const Objects& lists,
                             RayGroup<Real>& group)
{
    for (int first = 0; first < group_rays; first += lanes<Real>) {
        if (active_lanes(group, first) == 0)
            continue;
        HitPacket<Real> hit = load_hits(group, first);
        closest_hit<F>(hit, lists, load_rays(group, first));
        store_hits(group, first, hit);
    }
    if (!scene.tree.empty())
        closest_in_tree<F>(scene.tree, group);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
