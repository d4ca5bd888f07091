#pragma once

#include "kernels/bvh/cell_rays.hpp"
#include "kernels/bvh/copy_rays.hpp"

// Traverses the BVH with lists of rays of one octant of directions. A node is tested against all
// rays of its list one after another, and no ray waits for the branches of another (Barringer and
// Akenine-Möller, "Dynamic Ray Stream Traversal", 2014).
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Up to this many rays of a child are traversed alone, which is then faster.
inline constexpr int short_list = 2;

/// The capacity of all lists together, in rays. If a node's rays do not fit, they are traversed
/// alone.
inline constexpr int list_capacity = 16 * bundle_rays;

/// A child that is still to be visited, and its list.
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

/// Tests one ray against these boxes.
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

/// The rays of a bundle, sorted by the octant of their direction.
class OctantLists {
public:
    void add(const SlabRays& slabs, int ray)
    {
        int octant = 0;
        for (int axis = 0; axis < 3; ++axis)
            octant |= (slabs.inv[axis][ray] < 0.0f ? 1 : 0) << axis;
        rays_[octant][ray_count_[octant]++] = static_cast<std::uint8_t>(ray);
    }

    /// Calls `visit(octant, rays, count)` for each octant with at least one ray.
    template <class Visit>
    void for_each(const Visit& visit) const
    {
        for (int octant = 0; octant < octants; ++octant)
            if (ray_count_[octant] != 0)
                visit(octant, rays_[octant], ray_count_[octant]);
    }

private:
    static constexpr int octants = 8;
    int ray_count_[octants] = {};
    std::uint8_t rays_[octants][bundle_rays];
};

/// Fills cells, and lists their active rays.
template <class Real>
inline void list_rays(OctantLists& octants, SlabRays& slabs, const abi::BvhView<Real>& bvh,
                      const RayBundle<Real>& bundle, std::uint32_t cells)
{
    for (std::uint32_t left = cells; left != 0; left &= left - 1)
        fill_cell(slabs, bundle, __builtin_ctz(left), bvh.extent, bvh.slack);
    for_each_active(bundle, cells, [&](int ray) { octants.add(slabs, ray); });
}

/// Traverses the BVH with lists of rays of one octant.
template <class Real, class Visit>
class ListWalk {
public:
    /// `visit.leaf(child, ray)` is called for a ray and a leaf that it may hit, `visit.lone(child,
    /// ray)` for a ray that is traversed alone below a child. Both reduce the ray's t in the bundle
    /// when they find hits.
    ListWalk(const abi::BvhView<Real>& bvh, const SlabRays& slabs, const RayBundle<Real>& bundle,
             const Visit& visit)
        : bvh_(bvh), slabs_(slabs), bundle_(bundle), visit_(visit)
    {
    }

    /// Traverses rays of filled cells.
    void walk(int octant, const std::uint8_t* rays, int count)
    {
        for (int i = 0; i < count; ++i)
            lists_[i] = rays[i];
        push(0, 0, count);
        while (entry_count_ > 0) {
            const ListEntry entry = entries_[--entry_count_];
            if (entry.count > short_list && abi::is_leaf(entry.child))
                for (int i = 0; i < entry.count; ++i)
                    visit_.leaf(entry.child, lists_[entry.first + i]);
            else if (entry.count > short_list && fits_in_lists(entry))
                distribute(entry, octant);
            else
                for (int i = 0; i < entry.count; ++i)
                    visit_.lone(entry.child, lists_[entry.first + i]);
        }
    }

private:
    /// Whether the lists can hold all rays of the entry once per child.
    static bool fits_in_lists(const ListEntry& entry)
    {
        return entry.first + abi::node_width * entry.count < list_capacity;
    }

    void push(std::uint32_t child, int first, int count)
    {
        entries_[entry_count_++] = {child, static_cast<std::uint16_t>(first),
                                    static_cast<std::uint16_t>(count)};
    }

    /// Distributes the rays of a node to lists of its children; the list of the nearest child is on
    /// top.
    void distribute(const ListEntry& entry, int octant)
    {
        count_bundle_node();
        const abi::BvhNode& node = bvh_.nodes[entry.child];
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
            fetch_child(bvh_, node.child[slot]);
            const int first = end;
            end += copy_rays(lists_ + end, rays, met, entry.count, slot);
            push(node.child[slot], first, end - first);
        }
    }

    const abi::BvhView<Real>& bvh_;
    const SlabRays& slabs_;
    const RayBundle<Real>& bundle_;
    const Visit& visit_;
    int entry_count_ = 0;
    ListEntry entries_[walk_stack];
    std::uint8_t lists_[list_capacity + copy_step];
};

/// Traverses the BVH with the active rays of cells, in lists of one octant each; `slabs` is the one
/// that `visit` uses.
template <class Real, class Visit>
inline void walk_in_lists(const abi::BvhView<Real>& bvh, SlabRays& slabs,
                          const RayBundle<Real>& bundle, std::uint32_t cells, const Visit& visit)
{
    OctantLists octants;
    list_rays(octants, slabs, bvh, bundle, cells);
    ListWalk<Real, Visit> lists(bvh, slabs, bundle, visit);
    octants.for_each(
        [&](int octant, const std::uint8_t* rays, int count) { lists.walk(octant, rays, count); });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
