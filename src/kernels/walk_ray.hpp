#pragma once

#include "kernels/walk_cells.hpp"

// A single ray through the hierarchy, against the eight boxes of a node at once: for rays that
// share no way.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A ray as the boxes see it, in single precision with room for rounding.
struct SlabRay {
    float org_low[3];
    float org_high[3];
    float inv[3];
    float t_max;
};

/// `extent` and `slack` are the hierarchy's. A ray of a size that is not reckoned with meets
/// every box.
template <class Real>
inline SlabRay slab_ray(const RayGroup<Real>& group, int ray, float extent, float slack)
{
    float org[3], dir[3];
    float reach = 0.0f;
    float length = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        org[axis] = static_cast<float>(group.org[axis][ray]);
        dir[axis] = static_cast<float>(group.dir[axis][ray]);
        const float distance = __builtin_fabsf(org[axis]);
        const float size = __builtin_fabsf(dir[axis]);
        reach = reach > distance ? reach : distance;
        length = length > size ? length : size;
    }
    const bool reckoned = reach + extent <= largest_coordinate && length <= largest_coordinate &&
                          length >= smallest_length;
    const float pad = slack * (reach + extent);
    SlabRay slab;
    for (int axis = 0; axis < 3; ++axis) {
        const bool along = __builtin_fabsf(dir[axis]) <= smallest_component;
        slab.org_low[axis] = reckoned ? org[axis] - pad : -open_axis;
        slab.org_high[axis] = reckoned ? org[axis] + pad : open_axis;
        slab.inv[axis] = reckoned ? 1.0f / (along ? smallest_component : dir[axis]) : 1.0f;
    }
    return slab;
}

/// The ray against eight boxes.
inline SlabHits meet_boxes(const SlabRay& ray, const abi::BvhNode& node)
{
    Eight t_near(0.0f);
    Eight t_far(ray.t_max);
    for (int axis = 0; axis < 3; ++axis) {
        const bool against = ray.inv[axis] < 0.0f;
        const Eight inv(ray.inv[axis]);
        const float* const near = against ? node.high[axis] : node.low[axis];
        const float* const far = against ? node.low[axis] : node.high[axis];
        const Eight near_org(against ? ray.org_low[axis] : ray.org_high[axis]);
        const Eight far_org(against ? ray.org_high[axis] : ray.org_low[axis]);
        t_near = max8((load8(near) - near_org) * inv, t_near);
        t_far = min8((load8(far) - far_org) * inv, t_far);
    }
    return {t_near, less_equal8(t_near, t_far)};
}

/// A child still to be looked at by one ray.
struct RayEntry {
    std::uint32_t child;
    float t_near;
};

/// Calls `leaf(child)` for the leaves the ray may meet, nearest first as far as boxes tell,
/// until it returns false. `leaf` lowers `ray.t_max` as it finds hits.
template <class Leaf>
inline void walk_ray(const abi::BvhNode* nodes, SlabRay& ray, const Leaf& leaf)
{
    RayEntry stack[walk_stack];
    int size = 0;
    std::uint32_t child = 0;
    for (;;) {
        if (abi::is_leaf(child)) {
            if (!leaf(child))
                return;
        } else {
            const abi::BvhNode& node = nodes[child];
            const SlabHits slabs = meet_boxes(ray, node);
            alignas(32) float t_near[abi::node_width];
            store8(t_near, slabs.t_near);
            const int bottom = size;
            for (std::uint32_t left = slabs.hits; left != 0; left &= left - 1) {
                const int slot = __builtin_ctz(left);
                const float near = t_near[slot];
                int at = size++;
                for (; at > bottom && stack[at - 1].t_near < near; --at)
                    stack[at] = stack[at - 1];
                stack[at] = {node.child[slot], near};
            }
        }
        do {
            if (size == 0)
                return;
            --size;
        } while (stack[size].t_near > ray.t_max);
        child = stack[size].child;
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
