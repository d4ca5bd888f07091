#pragma once

#include "kernels/octants.hpp"
#include "kernels/tree_closest.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Rays that share no way: in cells of one octant each, and one by one where those are full.
template <abi::Features F, class Real>
[[gnu::noinline]] void closest_of_others(const abi::BvhView<Real>& tree, RayGroup<Real>& group,
                                         std::uint32_t cells)
{
    Regrouped<Real> octants;
    SlabRays slabs;
    sort_by_octant(group, cells, octants);
    CellBounds bounds;
    bound_cells(bounds, octants.rays, tree, Cells::all);
    for (int cell = 0; cell < octants.cells; ++cell)
        bounds.t_max[cell] = furthest(octants.rays, cell);
    const ClosestInTree<F, Real> closest(tree, octants.rays, bounds, slabs);
    for (int cell = 0; cell < octants.cells; ++cell) {
        walk_cells(tree, bounds, 1u << cell, closest);
        for (std::uint32_t left = octants.rays.active[cell]; left != 0; left &= left - 1) {
            const int ray = cell * cell_rays + __builtin_ctz(left);
            group.t[octants.from[ray]] = octants.rays.t[ray];
            group.surface[octants.from[ray]] = octants.rays.surface[ray];
        }
    }
    SlabRays rest;
    for (; cells != 0; cells &= cells - 1) {
        const int cell = __builtin_ctz(cells);
        std::uint32_t left = group.active[cell];
        if (left != 0)
            fill_cell(rest, group, cell, tree.extent, tree.slack);
        for (; left != 0; left &= left - 1)
            closest_of_ray<F>(tree, rest, group, cell * cell_rays + __builtin_ctz(left), 0);
    }
}

/// Brings the t and surface of a group's active rays down to their first hit in the hierarchy,
/// where that comes before.
template <abi::Features F, class Real>
[[gnu::noinline]] void closest_in_tree(const abi::BvhView<Real>& tree, RayGroup<Real>& group)
{
    const PartScope part(abi::Part::boxes);
    CellBounds bounds;
    bound_cells(bounds, group, tree);
    if (bounds.coherent != 0) {
        SlabRays slabs;
        closest_of_cells<F>(tree, group, bounds, slabs);
    }
    const std::uint32_t others = active_cells(group) & ~bounds.coherent;
    if (others == 0)
        return;
    std::uint16_t active[group_cells];
    for (int cell = 0; cell < group_cells; ++cell)
        active[cell] = group.active[cell];
    closest_of_others<F>(tree, group, others);
    for (int cell = 0; cell < group_cells; ++cell)
        group.active[cell] = active[cell];
}

/// The same among all objects of a scene, lists first: what stands in them is large.
template <abi::Features F, class Objects, class Real>
inline void closest_of_group(const abi::SceneView<Real>& scene, const Objects& lists,
                             RayGroup<Real>& group)
{
    for (int first = 0; first < group_rays; first += lanes<Real>) {
        if (active_lanes(group, first) == 0)
            continue;
        tell_live(active_lanes(group, first));
        HitPacket<Real> hit = load_hits(group, first);
        closest_hit<F>(hit, lists, load_rays(group, first));
        store_hits(group, first, hit);
    }
    if (!scene.tree.empty())
        closest_in_tree<abi::tree_features(F)>(scene.tree, group);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
