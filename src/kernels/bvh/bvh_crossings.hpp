#pragma once

#include "kernels/bvh/coherent_cells.hpp"
#include "kernels/bvh/walk_lists.hpp"
#include "kernels/lists/callback.hpp"

// All hits of a bundle of rays with the objects of the BVH, not only the closest ones.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Receives hits: rays of the packet at `first`, as bits, their t, and the surface that they hit.
template <class Real>
using CrossingVisitor =
    Callback<void(int first, std::uint32_t crosses, const vreal<Real>& t, std::int32_t surface)>;

/// Reports every hit with a leaf, for the packets of cells or for single rays.
template <abi::Features F, class Real>
class CrossingsInBvh {
public:
    CrossingsInBvh(const abi::BvhView<Real>& bvh, const RayBundle<Real>& bundle,
                   const CellBounds& bounds, SlabRays& slabs, const CrossingVisitor<Real>& visit)
        : bvh_(bvh), bundle_(bundle), bounds_(bounds), slabs_(slabs), visit_(visit)
    {
    }

    /// Tests a leaf that cells may hit.
    void operator()(std::uint32_t child, std::uint32_t cells) const
    {
        if (F.quadrics && abi::is_run(child)) {
            for (std::uint32_t left = cells; left != 0; left &= left - 1)
                packets_of(__builtin_ctz(left), [&](int first, const RayPacket<Real>& rays) {
                    run(child, first, rays, all_lanes<Real>);
                });
            return;
        }
        abi::SphereBlock<Real> gathered;
        const SphereLeaf<Real> leaf = sphere_leaf(bvh_, child, gathered);
        visit_spheres(bounds_, leaf.block, cells, [&](int slot, int cell) {
            packets_of(cell, [&](int first, const RayPacket<Real>& rays) {
                sphere(leaf, slot, first, rays, all_lanes<Real>);
            });
        });
    }

    /// Traverses what is below a child, for few rays of one cell.
    void few_rays(std::uint32_t child, int cell, std::uint32_t rays) const
    {
        for (; rays != 0; rays &= rays - 1)
            lone(child, cell * cell_rays + __builtin_ctz(rays));
    }

    /// Traverses what is below a child, for one ray of a filled cell.
    void lone(std::uint32_t child, int ray) const
    {
        SlabRay slab = slab_ray(slabs_, bundle_, ray);
        walk_ray(bvh_, child, slab, [&](std::uint32_t below) {
            leaf(below, ray);
            return true;
        });
    }

    /// Tests a leaf against one ray, by the operations of its packet.
    void leaf(std::uint32_t child, int ray) const
    {
        const int first = ray / lanes<Real> * lanes<Real>;
        const std::uint32_t lane = 1u << (ray - first);
        const RayPacket<Real> rays = load_rays(bundle_, first);
        if (F.quadrics && abi::is_run(child))
            return run(child, first, rays, lane);
        abi::SphereBlock<Real> gathered;
        const SphereLeaf<Real> spheres = sphere_leaf(bvh_, child, gathered);
        Real unused[abi::node_width];
        std::uint32_t met = BlockRay<Real>(bundle_, ray)
                                .first_roots(spheres.block, static_cast<Real>(no_end), unused);
        for (; met != 0; met &= met - 1)
            sphere(spheres, __builtin_ctz(met), first, rays, lane);
    }

private:
    template <class Cross>
    void packets_of(int cell, const Cross& cross) const
    {
        for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += lanes<Real>)
            if (active_lanes(bundle_, first) != 0)
                cross(first, load_rays(bundle_, first));
    }

    void sphere(const SphereLeaf<Real>& leaf, int slot, int first, const RayPacket<Real>& rays,
                std::uint32_t wanted) const
    {
        visit_roots(quadratic_of(leaf.block, slot, rays),
                    [&](vmask<Real> valid, const vreal<Real>& t) {
                        visit_(first, bits(valid) & wanted, t, leaf.surface_of(slot));
                    });
    }

    // Not inlined into each traversal: runs are rare, and their tests are long.
    [[gnu::noinline]] void run(std::uint32_t child, int first, const RayPacket<Real>& rays,
                               std::uint32_t wanted) const
    {
        const auto report = [&](const auto& record, const auto&) {
            visit_crossings(record, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
                visit_(first, bits(valid) & wanted, t, record.surface + piece);
            });
        };
        for (int i = 0; i < abi::run_count(child); ++i)
            with_object_of_run(bvh_, abi::first_of_run(child) + i, report);
    }

    const abi::BvhView<Real>& bvh_;
    const RayBundle<Real>& bundle_;
    const CellBounds& bounds_;
    SlabRays& slabs_;
    const CrossingVisitor<Real>& visit_;
};

/// Calls `visit` for every hit of the packets of a bundle with objects of the BVH. Only those with
/// a t before the ray's end are hits.
template <abi::Features F, class Real>
[[gnu::noinline]] void visit_crossings_in_bvh(const abi::BvhView<Real>& bvh,
                                              const RayBundle<Real>& bundle,
                                              const CrossingVisitor<Real>& visit)
{
    SlabRays slabs;
    CellBounds bounds;
    constexpr bool one_origin = false;
    bound_cells(bounds, bundle, bvh, bvh.spread, one_origin);
    const CrossingsInBvh<F, Real> crossings(bvh, bundle, bounds, slabs, visit);
    if (bounds.coherent != 0) {
        start_coherent(bounds, bundle);
        walk_cells(bvh, bounds, bounds.coherent, CellRays<Real>{bvh, slabs, bundle}, crossings);
    }
    const std::uint32_t others = active_cells(bundle) & ~bounds.coherent;
    if (others != 0)
        walk_in_lists(bvh, slabs, bundle, others, crossings);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
