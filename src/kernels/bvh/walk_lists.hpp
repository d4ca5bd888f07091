#pragma once

#include "kernels/bvh/cell_rays.hpp"
#include "kernels/bvh/copy_rays.hpp"

// Rays of one octant of directions through the hierarchy, listed by the boxes they meet: a node is
// looked at once for all of them, and no ray waits for another's branches (Barringer and
// Akenine-Möller, "Dynamic Ray Stream Traversal", 2014).
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Rays of a child that are better off each on its own way.
inline constexpr int short_list = 2;

/// How many rays all lists hold at most. Where a node's rays find no room, they go on alone.
inline constexpr int list_room = 16 * bundle_rays;

/// A child still to be looked at, and its list.
struct ListEntry {
    std::uint32_t child;
    std::uint16_t first;
    std::uint16_t count;
};

/// The faces by which rays of an octant enter and leave the boxes of a node.
struct FacingBoxes {
    vfloat8 enter[3];
    vfloat8 leave[3];

    FacingBoxes(const abi::BvhNode& node, int octant)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const bool backwards = (octant >> axis & 1) != 0;
            enter[axis] = load8(backwards ? node.high[axis] : node.low[axis]);
            leave[axis] = load8(backwards ? node.low[axis] : node.high[axis]);
        }
    }
};

/// One ray against them.
inline SlabHits meet_boxes(const FacingBoxes& boxes, const SlabRays& slabs, int ray, float t_max)
{
    vfloat8 t_near(0.0f);
    vfloat8 t_far(t_max);
    for (int axis = 0; axis < 3; ++axis) {
        const vfloat8 inv(slabs.inv[axis][ray]);
        t_near =
            max(about_msub(boxes.enter[axis], inv, vfloat8(slabs.near_org[axis][ray])), t_near);
        t_far = min(about_msub(boxes.leave[axis], inv, vfloat8(slabs.far_org[axis][ray])), t_far);
    }
    return {t_near, less_equal8(t_near, t_far)};
}

/// The rays of a bundle by the octant of their directions.
class OctantLists {
public:
    void add(const SlabRays& slabs, int ray)
    {
        int octant = 0;
        for (int axis = 0; axis < 3; ++axis)
            octant |= (slabs.inv[axis][ray] < 0.0f ? 1 : 0) << axis;
        rays_[octant][count_[octant]++] = static_cast<std::uint8_t>(ray);
    }

    /// Calls `visit(octant, rays, count)` for each octant that any ray is in.
    template <class Visit>
    void for_each(const Visit& visit) const
    {
        for (int octant = 0; octant < octants; ++octant)
            if (count_[octant] != 0)
                visit(octant, rays_[octant], count_[octant]);
    }

private:
    static constexpr int octants = 8;
    int count_[octants] = {};
    std::uint8_t rays_[octants][bundle_rays];
};

/// Lists the active rays of cells, which it fills.
template <class Real>
inline void list_rays(OctantLists& octants, SlabRays& slabs, const abi::BvhView<Real>& tree,
                      const RayBundle<Real>& bundle, std::uint32_t cells)
{
    for (std::uint32_t left = cells; left != 0; left &= left - 1)
        fill_cell(slabs, bundle, __builtin_ctz(left), tree.extent, tree.slack);
    for_each_active(bundle, cells, [&](int ray) { octants.add(slabs, ray); });
}

/// The walk of lists of rays of one octant.
template <class Real, class Visit>
class ListWalk {
public:
    /// `visit.leaf(child, ray)` is called for a ray and a leaf that it may meet, and
    /// `visit.lone(child, ray)` for one that goes on alone below a child. Both lower the ray's t in
    /// the bundle as they find hits.
    ListWalk(const abi::BvhView<Real>& tree, const SlabRays& slabs, const RayBundle<Real>& bundle,
             const Visit& visit)
        : tree_(tree), slabs_(slabs), bundle_(bundle), visit_(visit)
    {
    }

    /// Takes rays of filled cells.
    void walk(int octant, const std::uint8_t* rays, int count)
    {
        for (int i = 0; i < count; ++i)
            lists_[i] = rays[i];
        push(0, 0, count);
        while (size_ > 0) {
            const ListEntry entry = entries_[--size_];
            if (entry.count > short_list && abi::is_leaf(entry.child))
                for (int i = 0; i < entry.count; ++i)
                    visit_.leaf(entry.child, lists_[entry.first + i]);
            else if (entry.count > short_list && has_room(entry))
                share_out(entry, octant);
            else
                for (int i = 0; i < entry.count; ++i)
                    visit_.lone(entry.child, lists_[entry.first + i]);
        }
    }

private:
    /// Whether all its rays could be in the lists of all its children.
    static bool has_room(const ListEntry& entry)
    {
        return entry.first + abi::node_width * entry.count < list_room;
    }

    void push(std::uint32_t child, int first, int count)
    {
        entries_[size_++] = {child, static_cast<std::uint16_t>(first),
                             static_cast<std::uint16_t>(count)};
    }

    /// Lists the rays of a node by the children they meet, those of the nearest on top.
    void share_out(const ListEntry& entry, int octant)
    {
        count_bundle_node();
        const abi::BvhNode& node = tree_.nodes[entry.child];
        const FacingBoxes boxes(node, octant);
        std::uint8_t rays[bundle_rays];
        std::uint8_t met[bundle_rays];
        std::uint32_t any = 0;
        vfloat8 nearest(no_end);
        for (int i = 0; i < entry.count; ++i) {
            const int ray = rays[i] = lists_[entry.first + i];
            const SlabHits hits = meet_boxes(boxes, slabs_, ray, float_above(bundle_.t[ray]));
            met[i] = static_cast<std::uint8_t>(hits.hits);
            any |= hits.hits;
            nearest = min(nearest, hits.t_near);
        }
        const ChildOrder children(any, nearest);
        int end = entry.first;
        for (int child = 0; child < children.count; ++child) {
            const int slot = children.slot[child];
            fetch_child(tree_, node.child[slot]);
            const int first = end;
            end += copy_rays(lists_ + end, rays, met, entry.count, slot);
            push(node.child[slot], first, end - first);
        }
    }

    const abi::BvhView<Real>& tree_;
    const SlabRays& slabs_;
    const RayBundle<Real>& bundle_;
    const Visit& visit_;
    int size_ = 0;
    ListEntry entries_[walk_stack];
    std::uint8_t lists_[list_room + copy_step];
};

/// Takes the active rays of cells in lists of one octant each; `slabs` is the one that `visit`
/// sees.
template <class Real, class Visit>
inline void walk_in_lists(const abi::BvhView<Real>& tree, SlabRays& slabs,
                          const RayBundle<Real>& bundle, std::uint32_t cells, const Visit& visit)
{
    OctantLists octants;
    list_rays(octants, slabs, tree, bundle, cells);
    ListWalk<Real, Visit> lists(tree, slabs, bundle, visit);
    octants.for_each(
        [&](int octant, const std::uint8_t* rays, int count) { lists.walk(octant, rays, count); });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
