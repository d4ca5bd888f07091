#pragma once

#include "kernels/blocked_ray.hpp"
#include "kernels/tree_closest.hpp"
#include "kernels/walk_lists.hpp"

// What stands in the way of a group of rays among the objects of the hierarchy.
//
// A `Blocker` is called as blocker(surface, first, lanes) for an object and the lanes it blocks of
// the packet at `first`, and returns those lanes that nothing further matters to; they are taken
// out of the group's active rays. The rays' reach ends at the group's `t`, and is `closed` or not
// (occluded.hpp). A ray's own surface does not block it. With Features::exact only what blocks for
// sure is called for, and rays that something else may block are marked as unsure in the group.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The cells of a group.
template <abi::Features F, class Real, class Blocker>
class BlockersInTree {
public:
    BlockersInTree(const abi::BvhView<Real>& tree, RayGroup<Real>& group, CellBounds& bounds,
                   SlabRays& slabs, bool closed, const Blocker& blocker)
        : tree_(tree),
          group_(group),
          bounds_(bounds),
          slabs_(slabs),
          closed_(closed),
          blocker_(blocker)
    {
    }

    void operator()(std::uint32_t child, std::uint32_t cells) const
    {
        if constexpr (F.quadrics)
            if (abi::is_quadric_leaf(child))
                return quadrics(child, cells);
        abi::SphereBlock<Real> room;
        spheres(sphere_leaf(tree_, child, room), cells);
    }

    void few_rays(std::uint32_t child, int cell, std::uint32_t rays) const
    {
        for (; rays != 0; rays &= rays - 1)
            blockers_of_ray<F>(tree_, slabs_, group_, cell * cell_rays + __builtin_ctz(rays), child,
                               closed_, blocker_);
        if (group_.active[cell] == 0) {
            bounds_.t_max[cell] = -no_end;
            join_t_max(bounds_);
        }
    }

    std::uint32_t rays_of(int cell, const float (&low)[3], const float (&high)[3]) const
    {
        fill_cell(slabs_, group_, cell, tree_.extent, tree_.slack);
        return meet_rays(slabs_, group_, cell, low, high);
    }

private:
    void spheres(const SphereLeaf<Real>& leaf, std::uint32_t cells) const
    {
        const PartScope part(abi::Part::spheres);
        visit_spheres(bounds_, leaf.block, cells, [&](int slot, int cell) {
            object(abi::Primitive::sphere, cell, leaf.surface_of(slot),
                   [&](int first) { return sphere_occludes(leaf, slot, first); });
        });
        join_t_max(bounds_);
    }

    Occlusion sphere_occludes(const SphereLeaf<Real>& leaf, int slot, int first) const
    {
        const RayPacket<Real> rays = load_rays(group_, first);
        const vint<Real> own = load(group_.own + first);
        const std::int32_t surface = leaf.surface_of(slot);
        if constexpr (F.exact) {
            const Vec3v<float> center{vreal<float>(leaf.block.center[0][slot]),
                                      vreal<float>(leaf.block.center[1][slot]),
                                      vreal<float>(leaf.block.center[2][slot])};
            const vreal<float> radius(leaf.block.radius[slot]);
            const Vec3v<float> w = rays.org - center;
            const SphereApproach near = approach(w, leaf_outer2(group_, radius), rays);
            if (none(near.near))
                return {};
            const Occlusion occlusion =
                occludes({w, radius * radius, leaf_bounds(group_, radius)}, near, rays,
                         scale_of(group_, first, rays), load(group_.t + first));
            return {but_own<Real>(occlusion.blocked, own, surface),
                    but_own<Real>(occlusion.unsure, own, surface)};
        } else {
            const Reach<Real> reach{load(group_.t + first), closed_};
            return {
                but_own<Real>(bits(reach.blocked_by(quadratic_of(leaf.block, slot, rays), rays)),
                              own, surface),
                0};
        }
    }

    void quadrics(std::uint32_t child, std::uint32_t cells) const
    {
        const PartScope part(abi::Part::quadrics);
        for (int i = 0; i < abi::quadric_count(child); ++i) {
            const int number = abi::first_quadric(child) + i;
            const std::int32_t surface = leaf_quadric(tree_, number).surface;
            for (std::uint32_t left = cells; left != 0; left &= left - 1)
                object(abi::Primitive::quadric, __builtin_ctz(left), surface, [&](int first) {
                    return leaf_quadric_occludes<F>(tree_, number, group_, load_rays(group_, first),
                                                    load(group_.t + first),
                                                    load(group_.own + first), closed_);
                });
        }
        join_t_max(bounds_);
    }

    /// `occludes(first)` tells what one object does to the packet at `first`.
    template <class Occludes>
    void object(abi::Primitive kind, int cell, std::int32_t surface, const Occludes& occludes) const
    {
        for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += lanes<Real>) {
            const std::uint32_t active = active_lanes(group_, first);
            if (active == 0)
                continue;
            tell_live(active);
            count_tests(kind, 1);
            const Occlusion occlusion = occludes(first);
            if ((occlusion.unsure & active) != 0)
                doubt_lanes(group_, first, occlusion.unsure & active);
            const std::uint32_t blocked = occlusion.blocked & active;
            if (blocked != 0)
                finish_lanes(group_, first, blocker_(surface, first, blocked));
        }
        if (group_.active[cell] == 0)
            bounds_.t_max[cell] = -no_end;
    }

    const abi::BvhView<Real>& tree_;
    RayGroup<Real>& group_;
    CellBounds& bounds_;
    SlabRays& slabs_;
    bool closed_;
    const Blocker& blocker_;
};

/// Takes the coherent cells of a group as beams.
template <abi::Features F, class Real, class Blocker>
inline void blockers_of_cells(const abi::BvhView<Real>& tree, RayGroup<Real>& group,
                              CellBounds& bounds, bool closed, const Blocker& blocker)
{
    SlabRays slabs;
    start_coherent(bounds, group);
    walk_cells(tree, bounds, bounds.coherent,
               BlockersInTree<F, Real, Blocker>(tree, group, bounds, slabs, closed, blocker));
}

/// Takes listed rays each for itself.
template <abi::Features F, class Real, class Blocker>
struct BlockersOfListed {
    const abi::BvhView<Real>& tree;
    const SlabRays& slabs;
    RayGroup<Real>& group;
    bool closed;
    const Blocker& blocker;

    void leaf(std::uint32_t child, int ray) const
    {
        if (is_active(group, ray) &&
            !goes_behind_leaf<F>(tree, group, ray, BlockRay<Real>(group, ray), closed, child,
                                 blocker))
            end(ray);
    }
    void lone(std::uint32_t child, int ray) const
    {
        if (!is_active(group, ray))
            return;
        blockers_of_ray<F>(tree, slabs, group, ray, child, closed, blocker);
        if (!is_active(group, ray))
            end(ray);
    }

private:
    /// No box is met before a ray that has ended.
    void end(int ray) const
    {
        group.t[ray] = static_cast<Real>(-__builtin_inf());
    }
};

/// The active rays of cells that share no way.
template <abi::Features F, class Real, class Blocker>
inline void blockers_of_others(const abi::BvhView<Real>& tree, RayGroup<Real>& group,
                               std::uint32_t cells, bool closed, const Blocker& blocker)
{
    SlabRays slabs;
    walk_in_lists(tree, slabs, group, cells,
                  BlockersOfListed<F, Real, Blocker>{tree, slabs, group, closed, blocker});
}

/// Lists are let go of rays that are blocked, beams are not: cells go in lists earlier than where
/// closest hits are looked for; results/tree_designs.json.
inline constexpr float blocked_spread = 0.7f;

/// Meets the active rays of a group with what blocks them in the hierarchy.
template <abi::Features F, class Real, class Blocker>
[[gnu::noinline]] void visit_blockers_in_tree(const abi::BvhView<Real>& tree, RayGroup<Real>& group,
                                              bool closed, const Blocker& blocker)
{
    const PartScope part(abi::Part::boxes);
    CellBounds bounds;
    bound_cells(bounds, group, tree, blocked_spread * tree.spread);
    const std::uint32_t others = active_cells(group) & ~bounds.coherent;
    if (bounds.coherent != 0)
        blockers_of_cells<F>(tree, group, bounds, closed, blocker);
    if (others != 0)
        blockers_of_others<F>(tree, group, others, closed, blocker);
}

/// The same among all objects of a scene, lists first.
template <abi::Features F, class Objects, class Real, class Blocker>
inline void visit_blockers_of_group(const abi::GeometryView<Real>& scene, const Objects& lists,
                                    RayGroup<Real>& group, bool closed, const Blocker& blocker)
{
    std::uint32_t left = 0;
    for (int first = 0; first < group_rays; first += lanes<Real>) {
        const std::uint32_t wanted = active_lanes(group, first);
        if (wanted == 0)
            continue;
        tell_live(wanted);
        const auto take = [&](std::int32_t surface, std::uint32_t lanes_of) {
            const std::uint32_t blocked = lanes_of & active_lanes(group, first);
            if (blocked != 0)
                finish_lanes(group, first, blocker(surface, first, blocked));
            return active_lanes(group, first) != 0;
        };
        const RayPacket<Real> rays = load_rays(group, first);
        const vint<Real> own = load(group.own + first);
        if constexpr (F.exact) {
            const std::uint32_t unsure =
                visit_blockers<F>(load(group.t + first), lists, rays, own, take);
            doubt_lanes(group, first, unsure & wanted);
        } else {
            visit_blockers<F>(Reach<Real>{load(group.t + first), closed}, lists, rays, own, take);
        }
        left |= active_lanes(group, first);
    }
    if (left == 0 || scene.tree.empty())
        return;
    if constexpr (F.exact)
        bound_origins(group, scene.tree);
    visit_blockers_in_tree<abi::tree_features(F)>(scene.tree, group, closed, blocker);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
