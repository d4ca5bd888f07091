#pragma once

#include "kernels/occluded.hpp"
#include "kernels/places.hpp"
#include "kernels/tree_closest.hpp"

// What stands in the way of a group of rays among the objects of the hierarchy.
//
// A `Blocker` is called as blocker(surface, first, lanes) for an object and the lanes it blocks of
// the packet at `first`, and returns those lanes that nothing further matters to; they are taken
// out of the group's active rays. The rays' reach ends at the group's `t`, and is `closed` or not
// (occluded.hpp). A ray's surface in the group is its own, which does not block it; -1 for none.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The blocker of opaque shadows and of occlusion: each ends the rays it blocks.
struct EndsRays {
    std::uint32_t operator()(std::int32_t, int, std::uint32_t blocked) const
    {
        return blocked;
    }
};

/// Takes lanes of a packet out of the active ones.
template <class Real>
inline void finish_lanes(RayGroup<Real>& group, int first, std::uint32_t done)
{
    group.active[first / cell_rays] &= static_cast<std::uint16_t>(~(done << first % cell_rays));
}

/// One ray against all below `child`.
template <abi::Features F, class Real, class Blocker>
inline void blockers_of_ray(const abi::BvhView<Real>& tree, const SlabRays& slabs,
                            RayGroup<Real>& group, int ray, std::uint32_t child, bool closed,
                            const Blocker& blocker)
{
    const RayPacket<Real> rays = broadcast_ray(group, ray);
    const Reach<Real> reach{vreal<Real>(group.t[ray]), closed};
    SlabRay slab = slab_ray(slabs, group, ray);
    const int first = ray / lanes<Real> * lanes<Real>;
    const std::uint32_t lane = 1u << (ray - first);
    const vint<Real> own(group.surface[ray]);
    const auto goes_on = [&](std::int32_t surface) {
        finish_lanes(group, first, blocker(surface, first, lane));
        return (active_lanes(group, first) & lane) != 0;
    };
    walk_ray(tree, child, slab, [&](std::uint32_t leaf) {
        if (F.quadrics && abi::is_quadric_leaf(leaf)) {
            const PartScope part(abi::Part::quadrics);
            tell_live(1);
            const abi::QuadricRecord<Real>* quadric = tree.quadrics + abi::first_quadric(leaf);
            for (int i = 0; i < abi::quadric_count(leaf); ++i) {
                count_tests(abi::Primitive::quadric, 1);
                if (quadric_blocks(reach, quadric[i], rays, own) != 0 &&
                    !goes_on(quadric[i].surface))
                    return false;
            }
            return true;
        }
        const PartScope part(abi::Part::spheres);
        const abi::SphereBlock<Real>& block = tree.blocks[leaf & abi::block_mask];
        for (int from = 0; from < abi::node_width; from += lanes<Real>) {
            count_block_tests(block, from);
            std::uint32_t blocking =
                bits(reach.blocked_by(quadratics_of(block, from, rays), rays)) & block_lanes<Real>;
            for (; blocking != 0; blocking &= blocking - 1) {
                const auto surface =
                    static_cast<std::int32_t>(block.surface[from + __builtin_ctz(blocking)]);
                if (surface != group.surface[ray] && !goes_on(surface))
                    return false;
            }
        }
        return true;
    });
}

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
        spheres(tree_.blocks[child & abi::block_mask], cells);
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
    void spheres(const abi::SphereBlock<Real>& block, std::uint32_t cells) const
    {
        const PartScope part(abi::Part::spheres);
        visit_spheres(bounds_, block, cells, [&](int slot, int cell) {
            const auto surface = static_cast<std::int32_t>(block.surface[slot]);
            object(
                abi::Primitive::sphere, cell, surface,
                [&](const Reach<Real>& reach, const RayPacket<Real>& rays, const vint<Real>& own) {
                    return but_own<Real>(
                        bits(reach.blocked_by(quadratic_of(block, slot, rays), rays)), own,
                        surface);
                });
        });
        join_t_max(bounds_);
    }

    void quadrics(std::uint32_t child, std::uint32_t cells) const
    {
        const PartScope part(abi::Part::quadrics);
        const abi::QuadricRecord<Real>* quadric = tree_.quadrics + abi::first_quadric(child);
        for (int i = 0; i < abi::quadric_count(child); ++i)
            for (std::uint32_t left = cells; left != 0; left &= left - 1)
                object(abi::Primitive::quadric, __builtin_ctz(left), quadric[i].surface,
                       [&](const Reach<Real>& reach, const RayPacket<Real>& rays,
                           const vint<Real>& own) {
                           return quadric_blocks(reach, quadric[i], rays, own);
                       });
        join_t_max(bounds_);
    }

    /// `blocks(reach, rays, own)` tells the lanes of a packet that one object blocks.
    template <class Blocks>
    void object(abi::Primitive kind, int cell, std::int32_t surface, const Blocks& blocks) const
    {
        for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += lanes<Real>) {
            const std::uint32_t active = active_lanes(group_, first);
            if (active == 0)
                continue;
            tell_live(active);
            count_tests(kind, 1);
            const Reach<Real> reach{load(group_.t + first), closed_};
            const std::uint32_t blocked =
                blocks(reach, load_rays(group_, first), load(group_.surface + first)) & active;
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
                              CellBounds& bounds, SlabRays& slabs, bool closed,
                              const Blocker& blocker)
{
    start_coherent(bounds, group);
    walk_cells(tree, bounds, bounds.coherent,
               BlockersInTree<F, Real, Blocker>(tree, group, bounds, slabs, closed, blocker));
}

/// Takes the active rays of `cells` one by one.
template <abi::Features F, class Real, class Blocker>
inline void blockers_of_rays(const abi::BvhView<Real>& tree, RayGroup<Real>& group,
                             std::uint32_t cells, SlabRays& slabs, bool closed,
                             const Blocker& blocker)
{
    for (; cells != 0; cells &= cells - 1) {
        const int cell = __builtin_ctz(cells);
        fill_cell(slabs, group, cell, tree.extent, tree.slack);
        for (std::uint32_t left = group.active[cell]; left != 0; left &= left - 1)
            blockers_of_ray<F>(tree, slabs, group, cell * cell_rays + __builtin_ctz(left), 0,
                               closed, blocker);
    }
}

/// Takes cells each on its own way.
template <abi::Features F, class Real, class Blocker>
inline void blockers_of_lone_cells(const abi::BvhView<Real>& tree, Regrouped<Real>& sorted,
                                   bool closed, const Blocker& blocker)
{
    CellBounds bounds;
    SlabRays slabs;
    bound_cells(bounds, sorted.rays, tree, Cells::all);
    const BlockersInTree<F, Real, Blocker> blockers(tree, sorted.rays, bounds, slabs, closed,
                                                    blocker);
    for (int cell = 0; cell < sorted.cells; ++cell) {
        bounds.t_max[cell] = furthest(sorted.rays, cell);
        walk_cells(tree, bounds, 1u << cell, blockers);
    }
}

/// Meets the active rays of a group with what blocks them in the hierarchy.
template <abi::Features F, class Real, class Blocker>
[[gnu::noinline]] void visit_blockers_in_tree(const abi::BvhView<Real>& tree, RayGroup<Real>& group,
                                              bool closed, const Blocker& blocker)
{
    const PartScope part(abi::Part::boxes);
    CellBounds bounds;
    SlabRays slabs;
    bound_cells(bounds, group, tree);
    blockers_of_rays<F>(tree, group, active_cells(group) & ~bounds.coherent, slabs, closed,
                        blocker);
    if (bounds.coherent != 0)
        blockers_of_cells<F>(tree, group, bounds, slabs, closed, blocker);
}

/// The same where a blocker ends the rays: those that do not run together are sorted first.
template <abi::Features F, class Real>
[[gnu::noinline]] void visit_blockers_in_tree(const abi::BvhView<Real>& tree, RayGroup<Real>& group,
                                              bool closed, const EndsRays& blocker)
{
    const PartScope part(abi::Part::boxes);
    CellBounds bounds;
    SlabRays slabs;
    bound_cells(bounds, group, tree);
    const std::uint32_t others = active_cells(group) & ~bounds.coherent;
    if (bounds.coherent != 0)
        blockers_of_cells<F>(tree, group, bounds, slabs, closed, blocker);
    if (others == 0)
        return;
    Regrouped<Real> sorted;
    sort_by_place(group, others, sorted);
    std::uint16_t before[group_cells];
    for (int cell = 0; cell < group_cells; ++cell)
        before[cell] = sorted.rays.active[cell];
    blockers_of_lone_cells<F>(tree, sorted, closed, blocker);
    for (int cell = 0; cell < sorted.cells; ++cell)
        for (std::uint32_t ended = before[cell] & ~unsigned{sorted.rays.active[cell]}; ended != 0;
             ended &= ended - 1) {
            const int ray = sorted.from[cell * cell_rays + __builtin_ctz(ended)];
            group.active[ray / cell_rays] &= static_cast<std::uint16_t>(~(1u << ray % cell_rays));
        }
}

/// The same among all objects of a scene, lists first.
template <abi::Features F, class Objects, class Real, class Blocker>
inline void visit_blockers_of_group(const abi::SceneView<Real>& scene, const Objects& lists,
                                    RayGroup<Real>& group, bool closed, const Blocker& blocker)
{
    std::uint32_t left = 0;
    for (int first = 0; first < group_rays; first += lanes<Real>) {
        if (active_lanes(group, first) == 0)
            continue;
        tell_live(active_lanes(group, first));
        const Reach<Real> reach{load(group.t + first), closed};
        visit_blockers<F>(reach, lists, load_rays(group, first), load(group.surface + first),
                          [&](std::int32_t surface, std::uint32_t lanes_of) {
                              const std::uint32_t blocked = lanes_of & active_lanes(group, first);
                              if (blocked != 0)
                                  finish_lanes(group, first, blocker(surface, first, blocked));
                              return active_lanes(group, first) != 0;
                          });
        left |= active_lanes(group, first);
    }
    if (left != 0 && !scene.tree.empty())
        visit_blockers_in_tree<abi::tree_features(F)>(scene.tree, group, closed, blocker);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
