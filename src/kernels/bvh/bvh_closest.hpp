#pragma once

#include "kernels/bvh/closest_ray.hpp"
#include "kernels/bvh/coherent_cells.hpp"
#include "kernels/bvh/walk_lists.hpp"

// Closest hits of a bundle of rays with the objects of the BVH.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Tests leaves against the cells that may hit them.
template <abi::Features F, class Real>
class ClosestInBvh {
public:
    ClosestInBvh(const abi::BvhView<Real>& bvh, RayBundle<Real>& bundle, CellBounds& bounds,
                 SlabRays& slabs)
        : bvh_(bvh), bundle_(bundle), bounds_(bounds), slabs_(slabs)
    {
    }

    /// Tests a leaf that several cells may hit.
    void operator()(std::uint32_t child, std::uint32_t cells) const
    {
        if constexpr (F.quadrics)
            if (abi::is_run(child))
                return run(child, cells);
        abi::SphereBlock<Real> gathered;
        spheres(sphere_leaf(bvh_, child, gathered), cells);
    }

    /// Traverses what is below a child, for few rays of one cell.
    void few_rays(std::uint32_t child, int cell, std::uint32_t rays) const
    {
        for (; rays != 0; rays &= rays - 1)
            closest_of_ray<F>(bvh_, slabs_, bundle_, cell * cell_rays + __builtin_ctz(rays), child);
        bounds_.t_max[cell] = furthest(bundle_, cell);
        join_t_max(bounds_);
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

    /// `keep(first)` returns whether the packet at `first` may now have a closer hit.
    template <class Keep>
    bool sphere(int cell, const Keep& keep) const
    {
        bool any_closer = false;
        for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += lanes<Real>) {
            record_live(active_lanes(bundle_, first));
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

    // Not inlined into each traversal: runs are rare, and their tests are long.
    [[gnu::noinline]] void run(std::uint32_t child, std::uint32_t cells) const
    {
        const abi::Primitive kind = primitive_of_run(bvh_, abi::first_of_run(child));
        const StepScope step(step_of(kind));
        for (int i = 0; i < abi::run_count(child); ++i)
            for (std::uint32_t left = cells; left != 0; left &= left - 1)
                keep_object(kind, abi::first_of_run(child) + i, __builtin_ctz(left));
        join_t_max(bounds_);
    }

    void keep_object(abi::Primitive kind, int number, int cell) const
    {
        for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += lanes<Real>) {
            record_live(active_lanes(bundle_, first));
            count_tests(kind, 1);
            HitPacket<Real> hit = load_hits(bundle_, first);
            keep_of_run<F>(hit, bvh_, number, bundle_, load_rays(bundle_, first),
                           own_of(bundle_, first));
            store_hits<F>(bundle_, first, hit);
        }
        bounds_.t_max[cell] = furthest(bundle_, cell);
    }

    const abi::BvhView<Real>& bvh_;
    RayBundle<Real>& bundle_;
    CellBounds& bounds_;
    SlabRays& slabs_;
};

/// Closest hits of the coherent cells of a bundle.
template <abi::Features F, class Real>
inline void closest_of_cells(const abi::BvhView<Real>& bvh, RayBundle<Real>& bundle,
                             CellBounds& bounds)
{
    SlabRays slabs;
    start_coherent(bounds, bundle);
    walk_cells(bvh, bounds, bounds.coherent, CellRays<Real>{bvh, slabs, bundle},
               ClosestInBvh<F, Real>(bvh, bundle, bounds, slabs));
}

/// Searches the closest hits of listed rays.
template <abi::Features F, class Real>
struct ClosestOfListed {
    const abi::BvhView<Real>& bvh;
    const SlabRays& slabs;
    RayBundle<Real>& bundle;

    void leaf(std::uint32_t child, int ray) const
    {
        closest_of_leaf<F>(bvh, bundle, ray, BlockRay<Real>(bundle, ray), child);
    }
    void lone(std::uint32_t child, int ray) const
    {
        closest_of_ray<F>(bvh, slabs, bundle, ray, child);
    }
};

/// Closest hits of the active rays of cells that are not coherent.
template <abi::Features F, class Real>
[[gnu::noinline]] void closest_of_others(const abi::BvhView<Real>& bvh, RayBundle<Real>& bundle,
                                         std::uint32_t cells)
{
    SlabRays slabs;
    walk_in_lists(bvh, slabs, bundle, cells, ClosestOfListed<F, Real>{bvh, slabs, bundle});
}

/// Makes the hits of some rays of a bundle unsure.
struct DoubtHits {
    RayBundle<float>& bundle;

    void operator()(int first, std::uint32_t doubted) const
    {
        HitPacket<float> hit = load_hits(bundle, first);
        doubt_all(hit, from_bits<float>(doubted));
        store_hits<abi::Features{.exact = true}>(bundle, first, hit);
    }
};

/// Updates the t and surface of a bundle's active rays with closer hits in the BVH.
template <abi::Features F, class Real>
[[gnu::noinline]] void closest_in_bvh(const abi::GeometryView<Real>& scene, RayBundle<Real>& bundle)
{
    const StepScope step(abi::Step::boxes);
    const abi::BvhView<Real>& bvh = scene.tree;
    if constexpr (F.exact)
        bound_origins(bundle, scene, DoubtHits{bundle});
    CellBounds bounds;
    bound_cells(bounds, bundle, bvh, bvh.spread, F.exact && bundle.one_origin);
    if (bounds.coherent != 0)
        closest_of_cells<F>(bvh, bundle, bounds);
    const std::uint32_t others = active_cells(bundle) & ~bounds.coherent;
    if (others != 0)
        closest_of_others<F>(bvh, bundle, others);
}

/// The closest hits of a bundle with the objects of lists.
template <abi::Features F, class Objects, class Real>
[[gnu::noinline]] void closest_in_lists(const Objects& lists, RayBundle<Real>& bundle)
{
    for (int first = 0; first < bundle_rays; first += lanes<Real>) {
        const std::uint32_t active = active_lanes(bundle, first);
        if (active == 0)
            continue;
        record_live(active);
        HitPacket<Real> hit = load_hits(bundle, first);
        closest_hit<F>(hit, lists, load_rays(bundle, first), common_own_of(bundle, first, active));
        store_hits<F>(bundle, first, hit);
    }
}

/// The closest hits with all objects of a scene. Lists come first, as the objects in them are
/// large. Without a BVH, bundles are used in double precision only.
template <abi::Features F, class Objects, class Real>
inline void closest_of_bundle(const abi::GeometryView<Real>& scene, const Objects& lists,
                              RayBundle<Real>& bundle)
{
    constexpr abi::Features features = abi::tree_features(F);
    if (has_objects<features>(lists))
        closest_in_lists<features>(lists, bundle);
    if (!scene.tree.empty())
        closest_in_bvh<features>(scene, bundle);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
