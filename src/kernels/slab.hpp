#pragma once

#include "kernels/cell_bounds.hpp"

// Boxes against beams, by the distances at which the beam's rays enter and leave the slabs
// between opposite faces (Kay and Kajiya, "Ray Tracing Complex Scenes", 1986), in intervals.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where any ray of a beam may be inside a box.
struct SlabHits {
    Eight t_near;
    std::uint32_t hits;  ///< a bit each: near comes before far
};

/// Eight boxes side by side, however they come about.
struct EightBoxes {
    Eight low[3];
    Eight high[3];
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

/// A little more than a block's spheres take.
template <class Real>
inline EightBoxes boxes_of(const abi::SphereBlock<Real>& block)
{
    const Eight radius = Eight(1.000001f) * max8(load8(block.radius), Eight(0.0f));
    EightBoxes boxes;
    for (int axis = 0; axis < 3; ++axis) {
        const Eight center = load8(block.center[axis]);
        boxes.low[axis] = center - radius;
        boxes.high[axis] = center + radius;
    }
    return boxes;
}

/// One beam against eight boxes.
inline SlabHits meet_boxes(const CellBounds& bounds, int beam, const EightBoxes& boxes)
{
    Eight t_near(0.0f);
    Eight t_far(bounds.t_max[beam]);
    for (int axis = 0; axis < 3; ++axis) {
        const Eight inv_low(bounds.inv_low[axis][beam]);
        const Eight inv_high(bounds.inv_high[axis][beam]);
        Eight enter = boxes.low[axis] - Eight(bounds.org_high[axis][beam]);
        Eight leave = boxes.high[axis] - Eight(bounds.org_low[axis][beam]);
        if (bounds.inv_low[axis][beam] < 0.0f) {
            const Eight swapped = enter;
            enter = leave;
            leave = swapped;
        }
        t_near = max8(min8(enter * inv_low, enter * inv_high), t_near);
        t_far = min8(max8(leave * inv_low, leave * inv_high), t_far);
    }
    return {t_near, less_equal8(t_near, t_far)};
}

/// The cells of `cells` whose rays may meet one box.
inline std::uint32_t meet_cells(const CellBounds& bounds, const float (&low)[3],
                                const float (&high)[3], std::uint32_t cells)
{
    std::uint32_t hits = 0;
    for (int first = 0; first < group_cells; first += 8) {
        if ((cells >> first & 0xffu) == 0)
            continue;
        Eight t_near(0.0f);
        Eight t_far = load8(bounds.t_max + first);
        for (int axis = 0; axis < 3; ++axis) {
            const Eight inv_low = load8(bounds.inv_low[axis] + first);
            const Eight inv_high = load8(bounds.inv_high[axis] + first);
            const Eight over = Eight(low[axis]) - load8(bounds.org_high[axis] + first);
            const Eight under = Eight(high[axis]) - load8(bounds.org_low[axis] + first);
            const Eight enter = by_sign(inv_low, over, under);
            const Eight leave = by_sign(inv_low, under, over);
            t_near = max8(min8(enter * inv_low, enter * inv_high), t_near);
            t_far = min8(max8(leave * inv_low, leave * inv_high), t_far);
        }
        hits |= less_equal8(t_near, t_far) << first;
    }
    return hits & cells;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
