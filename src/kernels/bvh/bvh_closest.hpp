#pragma once

#include "kernels/bvh/closest_ray.hpp"
#include "kernels/bvh/coherent_cells.hpp"
#include "kernels/bvh/walk_lists.hpp"

// Closest hits of a bundle of rays among the objects of the hierarchy.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Tests one leaf after another against the cells that may meet it.
template <abi::Features F, class Real>
class ClosestInTree {
public:
    ClosestInTree(const abi::BvhView<Real>& tree, RayBundle<Real>& bundle, CellBounds& bounds,
                  SlabRays& slabs)
        : tree_(tree), bundle_(bundle), bounds_(bounds), slabs_(slabs)
    {
    }

    /// A leaf that several cells may meet.
    void operator()(std::uint32_t child, std::uint32_t cells) const
    {
        if constexpr (F.quadrics)
            if (abi::is_run(child))
                return run(child, cells);
        abi::SphereBlock<Real> room;
        spheres(sphere_leaf(tree_, child, room), cells);
    }

    /// Whatever is below a child that few rays of one cell may meet.
    void few_rays(std::uint32_t child, int cell, std::uint32_t rays) const
    {
        for (; rays != 0; rays &= rays - 1)
            closest_of_ray<F>(tree_, slabs_, bundle_, cell * cell_rays + __builtin_ctz(rays),
                              child);
        bounds_.t_max[cell] = furthest(bundle_, cell);
        join_t_max(bounds_);
    }

    /// The rays of a cell that may meet a box.
    std::uint32_t rays_of(int cell, const float (&low)[3], const float (&high)[3]) const
    {
        fill_cell(slabs_, bundle_, cell, tree_.extent, tree_.slack);
        return meet_rays(slabs_, bundle_, cell, low, high);
    }

private:
    void spheres(const SphereLeaf<Real>& leaf, std::uint32_t cells) const
    {
        const StepScope step(abi::Step::spheres);
        bool closer = false;
        if constexpr (F.exact) {
            BlockBounds bounds(bundle_, leaf.block);
            visit_spheres(bounds_, leaf.block, cells, [&](int slot, int cell) {
                bounds.need();
                closer |= sphere(cell, [&](int first) {
                    return keep_certain_sphere(bounds, slot, leaf.surface_of(slot), first);
                });
            });
        } else {
            visit_spheres(bounds_, leaf.block, cells, [&](int slot, int cell) {
                closer |=
                    sphere(cell, [&](int first) { return keep_rounded_sphere(leaf, slot, first); });
            });
        }
        if (closer)
            join_t_max(bounds_);
    }

    /// `keep(first)` tells whether the packet at `first` may have a closer hit now.
    template <class Keep>
    bool sphere(int cell, const Keep& keep) const
    {
        bool any_closer = false;
        for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += lanes<Real>) {
            tell_live(active_lanes(bundle_, first));
            count_tests(abi::Primitive::sphere, 1);
            any_closer |= keep(first);
        }
        if (any_closer)
            bounds_.t_max[cell] = furthest(bundle_, cell);
        return any_closer;
    }

    bool keep_certain_sphere(const BlockBounds& bounds, int slot, std::int32_t surface,
                             int first) const
    {
        const RayPacket<float> rays = load_rays(bundle_, first);
        const Vec3v<float> w = bounds.from_center(slot, rays);
        const SphereApproach near = approach(w, bounds.outer2(slot), rays);
        if (near.near == 0)
            return false;
        HitPacket<float> hit = load_hits(bundle_, first);
        keep_sphere(hit, bounds.test(slot, w), near, rays, scale_of(bundle_, first, rays), surface,
                    own_of(bundle_, first));
        store_hits<F>(bundle_, first, hit);
        return true;
    }

    bool keep_rounded_sphere(const SphereLeaf<Real>& leaf, int slot, int first) const
    {
        const RayPacket<Real> rays = load_rays(bundle_, first);
        const Quadratic<Real> quadratic = quadratic_of(leaf.block, slot, rays);
        if (none(may_hit(quadratic)))
            return false;
        HitPacket<Real> hit = load_hits(bundle_, first);
        keep_quadratic(hit, quadratic, rays, leaf.surface_of(slot), own_of(bundle_, first));
        store_hits<F>(bundle_, first, hit);
        return true;
    }

    // Not inlined into each way to walk: runs are few, and their tests are long.
    [[gnu::noinline]] void run(std::uint32_t child, std::uint32_t cells) const
    {
        const abi::Primitive kind = primitive_of_run(tree_, abi::first_of_run(child));
        const StepScope step(step_of(kind));
        for (int i = 0; i < abi::run_count(child); ++i)
            for (std::uint32_t left = cells; left != 0; left &= left - 1)
                keep_object(kind, abi::first_of_run(child) + i, __builtin_ctz(left));
        join_t_max(bounds_);
    }

    void keep_object(abi::Primitive kind, int number, int cell) const
    {
        for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += lanes<Real>) {
            tell_live(active_lanes(bundle_, first));
            count_tests(kind, 1);
            HitPacket<Real> hit = load_hits(bundle_, first);
            keep_of_run<F>(hit, tree_, number, bundle_, load_rays(bundle_, first),
                           own_of(bundle_, first));
            store_hits<F>(bundle_, first, hit);
        }
        bounds_.t_max[cell] = furthest(bundle_, cell);
    }

    const abi::BvhView<Real>& tree_;
    RayBundle<Real>& bundle_;
    CellBounds& bounds_;
    SlabRays& slabs_;
};

/// The same for the coherent cells of a bundle.
template <abi::Features F, class Real>
inline void closest_of_cells(const abi::BvhView<Real>& tree, RayBundle<Real>& bundle,
                             CellBounds& bounds)
{
    SlabRays slabs;
    start_coherent(bounds, bundle);
    walk_cells(tree, bounds, bounds.coherent, ClosestInTree<F, Real>(tree, bundle, bounds, slabs));
}

/// Tests listed rays for their closest hits.
template <abi::Features F, class Real>
struct ClosestOfListed {
    const abi::BvhView<Real>& tree;
    const SlabRays& slabs;
    RayBundle<Real>& bundle;

    void leaf(std::uint32_t child, int ray) const
    {
        closest_of_leaf<F>(tree, bundle, ray, BlockRay<Real>(bundle, ray), child);
    }
    void lone(std::uint32_t child, int ray) const
    {
        closest_of_ray<F>(tree, slabs, bundle, ray, child);
    }
};

/// The active rays of cells that share no way.
template <abi::Features F, class Real>
[[gnu::noinline]] void closest_of_others(const abi::BvhView<Real>& tree, RayBundle<Real>& bundle,
                                         std::uint32_t cells)
{
    SlabRays slabs;
    walk_in_lists(tree, slabs, bundle, cells, ClosestOfListed<F, Real>{tree, slabs, bundle});
}

/// Nothing is certain of what some rays of a bundle hit.
struct DoubtHits {
    RayBundle<float>& bundle;

    void operator()(int first, std::uint32_t doubted) const
    {
        HitPacket<float> hit = load_hits(bundle, first);
        doubt_all(hit, from_bits<float>(doubted));
        store_hits<abi::Features{.exact = true}>(bundle, first, hit);
    }
};

/// Brings the t and surface of a bundle's active rays down to their first hit in the hierarchy,
/// where that comes before.
template <abi::Features F, class Real>
[[gnu::noinline]] void closest_in_tree(const abi::GeometryView<Real>& scene,
                                       RayBundle<Real>& bundle)
{
    const StepScope step(abi::Step::boxes);
    const abi::BvhView<Real>& tree = scene.tree;
    if constexpr (F.exact)
        bound_origins(bundle, scene, DoubtHits{bundle});
    CellBounds bounds;
    bound_cells(bounds, bundle, tree, tree.spread, F.exact && bundle.one_origin);
    if (bounds.coherent != 0)
        closest_of_cells<F>(tree, bundle, bounds);
    const std::uint32_t others = active_cells(bundle) & ~bounds.coherent;
    if (others != 0)
        closest_of_others<F>(tree, bundle, others);
}

/// The closest hits of a bundle among the objects of lists.
template <abi::Features F, class Objects, class Real>
[[gnu::noinline]] void closest_in_lists(const Objects& lists, RayBundle<Real>& bundle)
{
    for (int first = 0; first < bundle_rays; first += lanes<Real>) {
        const std::uint32_t active = active_lanes(bundle, first);
        if (active == 0)
            continue;
        tell_live(active);
        HitPacket<Real> hit = load_hits(bundle, first);
        closest_hit<F>(hit, lists, load_rays(bundle, first), common_own_of(bundle, first, active));
        store_hits<F>(bundle, first, hit);
    }
}

/// The same among all objects of a scene, lists first: what stands in them is large. Without a
/// hierarchy single precision has no bundles.
template <abi::Features F, class Objects, class Real>
inline void closest_of_bundle(const abi::GeometryView<Real>& scene, const Objects& lists,
                              RayBundle<Real>& bundle)
{
    constexpr abi::Features features = abi::tree_features(F);
    if (has_objects<features>(lists))
        closest_in_lists<features>(lists, bundle);
    if (!scene.tree.empty())
        closest_in_tree<features>(scene, bundle);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
