#pragma once

#include "kernels/bvh/walk_cells.hpp"

// Traverses the BVH with a single ray, tested against the eight boxes of a node at once: for rays
// that are not coherent.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A ray prepared for tests against boxes, in single precision with allowance for rounding.
struct SlabRay {
    float near_org[3];  ///< times inv; moved so that boxes seem nearer
    float far_org[3];   ///< times inv; moved so that boxes seem further away
    float inv[3];       ///< 1 / direction
    float t_max;
    int near_row[3];  ///< where the ray enters, as a row of BvhNode: low x, y, z, high x, y, z
};

/// Tests a ray against eight boxes.
inline SlabHits meet_boxes(const SlabRay& ray, const abi::BvhNode& node)
{
    const float* const planes = node.low[0];
    vfloat8 t_near(0.0f);
    vfloat8 t_far(ray.t_max);
    for (int axis = 0; axis < 3; ++axis) {
        const vfloat8 inv(ray.inv[axis]);
        const int near = ray.near_row[axis];
        const int far = 2 * axis + 3 - near;
        t_near = max(
            about_msub(load8(planes + near * abi::node_width), inv, vfloat8(ray.near_org[axis])),
            t_near);
        t_far =
            min(about_msub(load8(planes + far * abi::node_width), inv, vfloat8(ray.far_org[axis])),
                t_far);
    }
    return {t_near, less_equal8(t_near, t_far)};
}

/// A child that is still to be visited by one ray.
struct RayEntry {
    std::uint32_t child;
    float t_near;
};

class RayStack {
public:
    void push(std::uint32_t child, float t_near)
    {
        entries_[entry_count_++] = {child, t_near};
    }
    /// Pops the next child that begins before `t_max`; false if there is none.
    bool pop(float t_max, std::uint32_t& child)
    {
        while (entry_count_ > 0) {
            const RayEntry& entry = entries_[--entry_count_];
            if (entry.t_near <= t_max) {
                child = entry.child;
                return true;
            }
        }
        return false;
    }

private:
    RayEntry entries_[walk_stack];
    int entry_count_ = 0;
};

/// Continues with the nearest child of a node that the ray hits, and pushes the others; false if it
/// hits none.
template <class Fetch>
inline bool enter_node(const abi::BvhNode& node, const SlabRay& ray, const Fetch& fetch,
                       RayStack& stack, std::uint32_t& child)
{
    count_ray_node();
    const SlabHits slabs = meet_boxes(ray, node);
    std::uint32_t left = slabs.hits;
    if (left == 0)
        return false;
    const int first = __builtin_ctz(left);
    left &= left - 1;
    if (left == 0) {
        child = node.child[first];
        return true;
    }
    alignas(32) float t_near[abi::node_width];
    store8(t_near, slabs.t_near);
    const int second = __builtin_ctz(left);
    left &= left - 1;
    if (left == 0) {
        const bool swapped = t_near[second] < t_near[first];
        const int near = swapped ? second : first;
        const int far = swapped ? first : second;
        fetch(node.child[near]);
        fetch(node.child[far]);
        stack.push(node.child[far], t_near[far]);
        child = node.child[near];
        return true;
    }
    const ChildOrder order(slabs.hits, slabs.t_near);
    for (int i = 0; i < order.count - 1; ++i) {
        const int slot = order.slot[i];
        fetch(node.child[slot]);
        stack.push(node.child[slot], t_near[slot]);
    }
    child = node.child[order.slot[order.count - 1]];
    fetch(child);
    return true;
}

/// Calls `leaf(child)` for the leaves below `child` that the ray may hit, nearest first as far as
/// boxes tell, until it returns false. `leaf` reduces `ray.t_max` when it finds hits.
template <class Real, class Leaf>
inline void walk_ray(const abi::BvhView<Real>& bvh, std::uint32_t child, SlabRay& ray,
                     const Leaf& leaf)
{
    const auto fetch = [&](std::uint32_t next) { fetch_child(bvh, next); };
    RayStack stack;
    for (;;) {
        if (!abi::is_leaf(child)) {
            if (enter_node(bvh.nodes[child], ray, fetch, stack, child))
                continue;
        } else if (!leaf(child)) {
            return;
        }
        if (!stack.pop(ray.t_max, child))
            return;
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
