#pragma once

#include "kernels/bvh/frustum.hpp"

// Tests boxes against frustums: compares the distances at which the frustum's rays enter and leave
// the slabs between opposite faces (Kay and Kajiya, "Ray Tracing Complex Scenes", 1986), in
// interval arithmetic.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The result of testing a frustum, or a ray, against eight boxes.
struct SlabHits {
    vfloat8 t_near;
    std::uint32_t hits;  ///< one bit per box: it is entered before it is left
};

/// Eight boxes side by side.
struct EightBoxes {
    vfloat8 low[3];
    vfloat8 high[3];
};

inline EightBoxes boxes_of(const abi::BvhNode& node)
{
    EightBoxes boxes;
    for (int axis = 0; axis < 3; ++axis) {
        boxes.low[axis] = load8(node.low[axis]);
        boxes.high[axis] = load8(node.high[axis]);
    }
    return boxes;
}

/// The boxes of a block's spheres, slightly enlarged.
template <class Real>
inline EightBoxes boxes_of(const abi::SphereBlock<Real>& block)
{
    const vfloat8 radius = vfloat8(1.000001f) * max(load8(block.radius), vfloat8(0.0f));
    EightBoxes boxes;
    for (int axis = 0; axis < 3; ++axis) {
        const vfloat8 center = load8(block.center[axis]);
        boxes.low[axis] = center - radius;
        boxes.high[axis] = center + radius;
    }
    return boxes;
}

/// Tests one frustum against eight boxes.
inline SlabHits meet_boxes(const CellBounds& bounds, int frustum, const EightBoxes& boxes)
{
    vfloat8 t_near(0.0f);
    vfloat8 t_far(bounds.t_max[frustum]);
    for (int axis = 0; axis < 3; ++axis) {
        const vfloat8 inv_low(bounds.inv_low[axis][frustum]);
        const vfloat8 inv_high(bounds.inv_high[axis][frustum]);
        vfloat8 enter = boxes.low[axis] - vfloat8(bounds.org_high[axis][frustum]);
        vfloat8 leave = boxes.high[axis] - vfloat8(bounds.org_low[axis][frustum]);
        if (bounds.inv_low[axis][frustum] < 0.0f) {
            const vfloat8 swapped = enter;
            enter = leave;
            leave = swapped;
        }
        t_near = max(min(enter * inv_low, enter * inv_high), t_near);
        t_far = min(max(leave * inv_low, leave * inv_high), t_far);
    }
    return {t_near, less_equal8(t_near, t_far)};
}

/// The cells of `cells` whose rays may hit one box.
inline std::uint32_t meet_cells(const CellBounds& bounds, const float (&low)[3],
                                const float (&high)[3], std::uint32_t cells)
{
    std::uint32_t hits = 0;
    for (int first = 0; first < bundle_cells; first += 8) {
        if ((cells >> first & 0xffu) == 0)
            continue;
        vfloat8 t_near(0.0f);
        vfloat8 t_far = load8(bounds.t_max + first);
        for (int axis = 0; axis < 3; ++axis) {
            const vfloat8 inv_low = load8(bounds.inv_low[axis] + first);
            const vfloat8 inv_high = load8(bounds.inv_high[axis] + first);
            const vfloat8 over = vfloat8(low[axis]) - load8(bounds.org_high[axis] + first);
            const vfloat8 under = vfloat8(high[axis]) - load8(bounds.org_low[axis] + first);
            const vfloat8 enter = blend(inv_low, over, under);
            const vfloat8 leave = blend(inv_low, under, over);
            t_near = max(min(enter * inv_low, enter * inv_high), t_near);
            t_far = min(max(leave * inv_low, leave * inv_high), t_far);
        }
        hits |= less_equal8(t_near, t_far) << first;
    }
    return hits & cells;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
