#pragma once

#include "kernels/traverse/coherent_cells.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Takes every crossing of the leaves that cells may meet.
template <abi::Features F, class Real, class Visit>
class CrossingsInTree {
public:
    CrossingsInTree(const abi::BvhView<Real>& tree, const RayBundle<Real>& bundle,
                    const CellBounds& bounds, const Visit& visit)
        : tree_(tree), bundle_(bundle), bounds_(bounds), visit_(visit)
    {
    }

    void operator()(std::uint32_t child, std::uint32_t cells) const
    {
        if (F.quadrics && abi::is_run(child)) {
            for (int i = 0; i < abi::run_count(child); ++i)
                for (std::uint32_t left = cells; left != 0; left &= left - 1)
                    object(abi::first_of_run(child) + i, __builtin_ctz(left));
            return;
        }
        abi::SphereBlock<Real> room;
        const SphereLeaf<Real> leaf = sphere_leaf(tree_, child, room);
        visit_spheres(bounds_, leaf.block, cells,
                      [&](int slot, int cell) { sphere(leaf, slot, cell); });
    }

    // Rays stay together: what they meet does not end them.
    void few_rays(std::uint32_t, int, std::uint32_t) const
    {
    }
    std::uint32_t rays_of(int, const float (&)[3], const float (&)[3]) const
    {
        return ~0u;
    }

private:
    template <class Cross>
    void packets_of(int cell, const Cross& cross) const
    {
        for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += lanes<Real>)
            if (active_lanes(bundle_, first) != 0)
                cross(first, load_rays(bundle_, first));
    }

    void sphere(const SphereLeaf<Real>& leaf, int slot, int cell) const
    {
        packets_of(cell, [&](int first, const RayPacket<Real>& rays) {
            visit_roots(quadratic_of(leaf.block, slot, rays),
                        [&](vmask<Real> valid, const vreal<Real>& t) {
                            visit_(first, valid, t, leaf.surface_of(slot));
                        });
        });
    }

    void object(int number, int cell) const
    {
        with_object_of_run(tree_, number, [&](const auto& record, const auto&) {
            packets_of(cell, [&](int first, const RayPacket<Real>& rays) {
                visit_crossings(record, rays,
                                [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
                                    visit_(first, valid, t, record.surface + piece);
                                });
            });
        });
    }

    const abi::BvhView<Real>& tree_;
    const RayBundle<Real>& bundle_;
    const CellBounds& bounds_;
    const Visit& visit_;
};

/// Calls `visit(first, valid, t, surface)` for every crossing of the objects of the hierarchy with
/// the packets of a bundle; only those where `valid`, and with a t before the ray's, are one.
template <abi::Features F, class Real, class Visit>
inline void visit_crossings_in_tree(const abi::BvhView<Real>& tree, const RayBundle<Real>& bundle,
                                    const Visit& visit)
{
    CellBounds bounds;
    bound_cells(bounds, bundle, tree, tree.spread, Cells::all);
    start_coherent(bounds, bundle);
    walk_cells(tree, bounds, bounds.coherent,
               CrossingsInTree<F, Real, Visit>(tree, bundle, bounds, visit));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
