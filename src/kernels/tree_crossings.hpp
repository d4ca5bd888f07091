#pragma once

#include "kernels/tree_closest.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Calls `visit(first, valid, t, surface)` for every crossing of the objects of the hierarchy with
/// the packets of a group; only those where `valid`, and with a t before the ray's, are one.
template <abi::Features F, class Real, class Visit>
inline void visit_crossings_in_tree(const abi::BvhView<Real>& tree, const RayGroup<Real>& group,
                                    const Visit& visit)
{
    CellBounds bounds;
    bound_cells(bounds, group, tree.extent, tree.slack, Cells::all);
    for (int cell = 0; cell < group_cells; ++cell)
        bounds.t_max[cell] = group.active[cell] != 0 ? furthest(group, cell) : -no_end;
    join_t_max(bounds);
    const auto packets_of = [&](int cell, const auto& cross) {
        for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += lanes<Real>)
            if (active_lanes(group, first) != 0)
                cross(first, load_rays(group, first));
    };
    const auto meet_sphere = [&](const abi::SphereBlock<Real>& block, int slot, int cell) {
        packets_of(cell, [&](int first, const RayPacket<Real>& rays) {
            visit_roots(quadratic_of(block, slot, rays),
                        [&](vmask<Real> valid, const vreal<Real>& t) {
                            visit(first, valid, t, static_cast<std::int32_t>(block.surface[slot]));
                        });
        });
    };
    const auto meet_quadric = [&](const abi::QuadricRecord<Real>& quadric, int cell) {
        packets_of(cell, [&](int first, const RayPacket<Real>& rays) {
            visit_crossings(quadric, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
                visit(first, valid, t, quadric.surface + piece);
            });
        });
    };
    walk_cells(tree.nodes, bounds, bounds.coherent, [&](std::uint32_t child, std::uint32_t cells) {
        if (F.quadrics && abi::is_quadric_leaf(child)) {
            for (int i = 0; i < abi::quadric_count(child); ++i)
                for (std::uint32_t left = cells; left != 0; left &= left - 1)
                    meet_quadric(tree.quadrics[abi::first_quadric(child) + i], __builtin_ctz(left));
            return;
        }
        const abi::SphereBlock<Real>& block = tree.blocks[child & abi::block_mask];
        visit_spheres(bounds, block, cells,
                      [&](int slot, int cell) { meet_sphere(block, slot, cell); });
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
