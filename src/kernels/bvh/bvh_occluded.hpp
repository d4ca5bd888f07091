#pragma once

#include "kernels/bvh/coherent_cells.hpp"
#include "kernels/bvh/light_buffer.hpp"
#include "kernels/bvh/occluded_ray.hpp"
#include "kernels/bvh/walk_lists.hpp"

// Occlusion of a bundle of rays by the objects of the BVH.
//
// Rays that need no further occluders (Occluder) are removed from the bundle's active rays. Rays
// end at the bundle's `t`; their `interval` is open or closed (RayEnd). The surface that a ray
// starts on does not occlude it. With Features::exact only certain occluders count, and rays that
// may have others are marked as unsure in the bundle.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Tests leaves against the cells that may hit them.
template <abi::Features F, class Real>
class OccludersInBvh {
public:
    OccludersInBvh(const abi::BvhView<Real>& bvh, RayBundle<Real>& bundle, CellBounds& bounds,
                   SlabRays& slabs, RayInterval interval, const Occluder& occluder)
        : bvh_(bvh),
          bundle_(bundle),
          bounds_(bounds),
          slabs_(slabs),
          interval_(interval),
          occluder_(occluder)
    {
    }

    void operator()(std::uint32_t child, std::uint32_t cells) const
    {
        if constexpr (F.quadrics)
            if (abi::is_run(child))
                return run(child, cells);
        abi::SphereBlock<Real> gathered;
        spheres(sphere_leaf(bvh_, child, gathered), cells);
    }

    void few_rays(std::uint32_t child, int cell, std::uint32_t rays) const
    {
        for (; rays != 0; rays &= rays - 1)
            occluders_of_ray<F>(bvh_, slabs_, bundle_, cell * cell_rays + __builtin_ctz(rays),
                                child, interval_, occluder_);
        if (bundle_.active[cell] == 0) {
            bounds_.t_max[cell] = -no_end;
            join_t_max(bounds_);
        }
    }

private:
    void spheres(const SphereLeaf<Real>& leaf, std::uint32_t cells) const
    {
        const StepScope step(abi::Step::spheres);
        if constexpr (F.exact) {
            BlockBounds bounds(bundle_, leaf.block);
            visit_spheres(bounds_, leaf.block, cells, [&](int slot, int cell) {
                const std::int32_t surface = leaf.surface_of(slot);
                bounds.need();
                object(abi::Primitive::sphere, cell, surface, [&](int first) {
                    return certain_sphere_occludes(bounds, slot, surface, first);
                });
            });
        } else {
            visit_spheres(bounds_, leaf.block, cells, [&](int slot, int cell) {
                object(abi::Primitive::sphere, cell, leaf.surface_of(slot),
                       [&](int first) { return rounded_sphere_occludes(leaf, slot, first); });
            });
        }
        join_t_max(bounds_);
    }

    Occlusion certain_sphere_occludes(const BlockBounds& bounds, int slot, std::int32_t surface,
                                      int first) const
    {
        if (surface < 0)
            return {};
        const RayPacket<float> rays = load_rays(bundle_, first);
        const Vec3v<float> w = bounds.from_center(slot, rays);
        const SphereApproach near = approach(w, bounds.outer2(slot), rays);
        if (near.near == 0)
            return {};
        const OwnSurface<vint<float>> own = own_of(bundle_, first);
        const Occlusion occlusion =
            occludes(bounds.test(slot, w), near, rays, scale_of(bundle_, first, rays),
                     load(bundle_.t + first));
        return decided_alone(but_own<float>(occlusion.blocked, own, {surface, 1}),
                             but_own<float>(occlusion.unsure, own, {surface, 1}), surface, first);
    }

    Occlusion rounded_sphere_occludes(const SphereLeaf<Real>& leaf, int slot, int first) const
    {
        const RayPacket<Real> rays = load_rays(bundle_, first);
        const RayEnd<Real> end{load(bundle_.t + first), interval_};
        return {but_own<Real>(bits(end.blocked_by(quadratic_of(leaf.block, slot, rays), rays)),
                              own_of(bundle_, first), {leaf.surface_of(slot), 1}),
                0};
    }

    /// Decides the lanes of `unsure` in double, one by one.
    Occlusion decided_alone(std::uint32_t blocked, std::uint32_t unsure, std::int32_t surface,
                            int first) const
    {
        std::uint32_t left = unsure & active_lanes(bundle_, first);
        Occlusion result{blocked, 0};
        for (; left != 0; left &= left - 1) {
            const std::uint32_t lane = left & -left;
            const int ray = first + __builtin_ctz(left);
            const InDouble blocks = is_in_the_way(sphere_of(*bvh_.shapes, surface),
                                                  wide_ray(bundle_, ray), bundle_.t[ray]);
            result.blocked |= blocks == InDouble::yes ? lane : 0;
            result.unsure |= blocks == InDouble::undecided ? lane : 0;
        }
        return result;
    }

    // Not inlined into each traversal: runs are rare, and their tests are long.
    [[gnu::noinline]] void run(std::uint32_t child, std::uint32_t cells) const
    {
        const abi::Primitive kind = primitive_of_run(bvh_, abi::first_of_run(child));
        const StepScope step(step_of(kind));
        for (int i = 0; i < abi::run_count(child); ++i) {
            const int number = abi::first_of_run(child) + i;
            const std::int32_t surface = bvh_.run_surfaces[number];
            for (std::uint32_t left = cells; left != 0; left &= left - 1)
                object(kind, __builtin_ctz(left), surface, [&](int first) {
                    return object_occludes<F>(bvh_, number, bundle_, load_rays(bundle_, first),
                                              load(bundle_.t + first), own_of(bundle_, first),
                                              interval_);
                });
        }
        join_t_max(bounds_);
    }

    /// `occludes(first)` returns which lanes of the packet at `first` one object occludes.
    template <class Occludes>
    void object(abi::Primitive kind, int cell, std::int32_t surface, const Occludes& occludes) const
    {
        for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += lanes<Real>) {
            const std::uint32_t active = active_lanes(bundle_, first);
            if (active == 0)
                continue;
            record_live(active);
            count_tests(kind, 1);
            const Occlusion occlusion = occludes(first);
            if ((occlusion.unsure & active) != 0)
                doubt_lanes(bundle_, first, occlusion.unsure & active);
            const std::uint32_t blocked = occlusion.blocked & active;
            if (blocked != 0)
                finish_lanes(bundle_, first, occluder_(surface, first, blocked));
        }
        if (bundle_.active[cell] == 0)
            bounds_.t_max[cell] = -no_end;
    }

    const abi::BvhView<Real>& bvh_;
    RayBundle<Real>& bundle_;
    CellBounds& bounds_;
    SlabRays& slabs_;
    RayInterval interval_;
    const Occluder& occluder_;
};

/// Finds the occluders of the coherent cells of a bundle, as frustums.
template <abi::Features F, class Real>
inline void occluders_of_cells(const abi::BvhView<Real>& bvh, RayBundle<Real>& bundle,
                               CellBounds& bounds, RayInterval interval, const Occluder& occluder)
{
    SlabRays slabs;
    start_coherent(bounds, bundle);
    walk_cells(bvh, bounds, bounds.coherent, CellRays<Real>{bvh, slabs, bundle},
               OccludersInBvh<F, Real>(bvh, bundle, bounds, slabs, interval, occluder));
}

/// Finds the occluders of listed rays, ray by ray.
template <abi::Features F, class Real>
struct OccludersOfListed {
    const abi::BvhView<Real>& bvh;
    const SlabRays& slabs;
    RayBundle<Real>& bundle;
    RayInterval interval;
    const Occluder& occluder;

    void leaf(std::uint32_t child, int ray) const
    {
        if (is_active(bundle, ray) &&
            !goes_behind_leaf<F>(bvh, bundle, ray, BlockRay<Real>(bundle, ray), interval, child,
                                 occluder))
            end(ray);
    }
    void lone(std::uint32_t child, int ray) const
    {
        if (!is_active(bundle, ray))
            return;
        occluders_of_ray<F>(bvh, slabs, bundle, ray, child, interval, occluder);
        if (!is_active(bundle, ray))
            end(ray);
    }

private:
    /// A ray that has ended hits no box.
    void end(int ray) const
    {
        bundle.t[ray] = static_cast<Real>(-__builtin_inf());
    }
};

/// Finds the occluders of the active rays of cells that are not coherent.
template <abi::Features F, class Real>
inline void occluders_of_others(const abi::BvhView<Real>& bvh, RayBundle<Real>& bundle,
                                std::uint32_t cells, RayInterval interval, const Occluder& occluder)
{
    SlabRays slabs;
    walk_in_lists(bvh, slabs, bundle, cells,
                  OccludersOfListed<F, Real>{bvh, slabs, bundle, interval, occluder});
}

/// An occluded ray leaves a list but still widens a frustum, so shadow rays use lists at a smaller
/// spread than closest hits; results/tree_designs.json.
inline constexpr float blocked_spread = 0.7f;
/// A light buffer is faster than lists, so cells use it at an even smaller spread;
/// results/light_buffers.json.
inline constexpr float buffered_spread = 0.2f;

/// Finds the occluders of a bundle's active rays in the BVH. Rays that are not coherent use
/// `buffer`, if given, the light buffer of the light that all rays start at or run towards. Rays
/// that the buffer shows to be occluded end without a call of `occluder`.
template <abi::Features F, class Real>
[[gnu::noinline]] void visit_occluders_in_bvh(const abi::BvhView<Real>& bvh,
                                              const abi::LightBuffer* buffer,
                                              RayBundle<Real>& bundle, RayInterval interval,
                                              const Occluder& occluder)
{
    const StepScope step(abi::Step::boxes);
    CellBounds bounds;
    const float share = F.exact && buffer != nullptr ? buffered_spread : blocked_spread;
    bound_cells(bounds, bundle, bvh, share * bvh.spread, F.exact && bundle.one_origin);
    std::uint32_t others = active_cells(bundle) & ~bounds.coherent;
    if (bounds.coherent != 0)
        occluders_of_cells<F>(bvh, bundle, bounds, interval, occluder);
    if constexpr (F.exact)
        if (buffer != nullptr && others != 0) {
            const std::uint32_t beyond = cells_beyond(*buffer, bundle, others);
            end_in_light_buffer(*buffer, *bvh.shapes, bundle, others & ~beyond);
            others = beyond;
        }
    if (others != 0)
        occluders_of_others<F>(bvh, bundle, others, interval, occluder);
}

/// The same for the objects of lists. Returns whether any ray is still active.
template <abi::Features F, class Objects, class Real>
[[gnu::noinline]] bool visit_listed_occluders(const Objects& lists, RayBundle<Real>& bundle,
                                              RayInterval interval, const Occluder& occluder)
{
    std::uint32_t left = 0;
    for (int first = 0; first < bundle_rays; first += lanes<Real>) {
        const std::uint32_t wanted = active_lanes(bundle, first);
        if (wanted == 0)
            continue;
        record_live(wanted);
        const auto take = [&](std::int32_t surface, std::uint32_t lanes_of) {
            const std::uint32_t blocked = lanes_of & active_lanes(bundle, first);
            if (blocked != 0)
                finish_lanes(bundle, first, occluder(surface, first, blocked));
            return active_lanes(bundle, first) != 0;
        };
        const RayPacket<Real> rays = load_rays(bundle, first);
        const OwnSurface<vint<Real>> own = common_own_of(bundle, first, wanted);
        if constexpr (F.exact) {
            const std::uint32_t unsure = visit_occluders<F, Order::by_distance>(
                load(bundle.t + first), lists, rays, own, take);
            doubt_lanes(bundle, first, unsure & wanted);
        } else {
            visit_occluders<F>(RayEnd<Real>{load(bundle.t + first), interval}, lists, rays, own,
                               take);
        }
        left |= active_lanes(bundle, first);
    }
    return left != 0;
}

/// Rays of a bundle whose magnitudes the error bounds do not hold for. They are unsure, and are
/// deactivated during the search in single precision.
class RaysAside {
public:
    explicit RaysAside(RayBundle<float>& bundle) : bundle_(bundle)
    {
    }
    ~RaysAside()
    {
        for (int cell = 0; cell < bundle_cells; ++cell)
            bundle_.active[cell] |= aside_[cell];
    }
    RaysAside(const RaysAside&) = delete;
    RaysAside& operator=(const RaysAside&) = delete;

    void operator()(int first, std::uint32_t doubted)
    {
        note_in_the_way(doubted, abi::Cause::magnitude);
        doubt_lanes(bundle_, first, doubted);
        aside_[first / cell_rays] |= static_cast<std::uint16_t>(doubted << first % cell_rays);
        finish_lanes(bundle_, first, doubted);
    }

private:
    RayBundle<float>& bundle_;
    std::uint16_t aside_[bundle_cells] = {};
};

/// Finds the occluders of a bundle among all objects of a scene, lists first.
template <abi::Features F, class Objects, class Real>
inline void visit_occluders_of_bundle(const abi::GeometryView<Real>& scene, const Objects& lists,
                                      RayBundle<Real>& bundle, RayInterval interval,
                                      const Occluder& occluder,
                                      const abi::LightBuffer* buffer = nullptr)
{
    constexpr abi::Features features = abi::tree_features(F);
    if (has_objects<features>(lists)
            ? !visit_listed_occluders<features>(lists, bundle, interval, occluder)
            : active_cells(bundle) == 0)
        return;
    if constexpr (F.exact) {
        RaysAside aside(bundle);
        if (scene.tree.empty())
            return lists.certifiable ? doubt_uncertifiable(bundle, aside)
                                     : doubt_active(bundle, aside);
        bound_origins(bundle, scene, aside);
        if (active_cells(bundle) != 0)
            visit_occluders_in_bvh<features>(scene.tree, buffer, bundle, interval, occluder);
    } else if (!scene.tree.empty()) {
        visit_occluders_in_bvh<features>(scene.tree, buffer, bundle, interval, occluder);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
