#pragma once

#include "kernels/walk_ray.hpp"

// The rays of one cell, each for itself, against a box: where boxes are small against a cell,
// few of its rays meet them.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A group's rays as boxes see them, cell by cell, filled when a cell first needs it.
struct SlabRays {
    alignas(32) float near_org[3][group_rays];  ///< times inv; moved so that boxes seem nearer
    alignas(32) float far_org[3][group_rays];   ///< and further
    alignas(32) float inv[3][group_rays];       ///< 1 / direction
    std::uint32_t filled = 0;                   ///< a bit a cell
};

template <class Real>
inline void fill_cell(SlabRays& slabs, const RayGroup<Real>& group, int cell, float extent,
                      float slack)
{
    if (slabs.filled >> cell & 1u)
        return;
    slabs.filled |= 1u << cell;
    const Eight zero(0.0f);
    for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += 8) {
        Eight reach(0.0f);
        Eight length(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const Eight org = load8(group.org[axis] + first);
            const Eight dir = load8(group.dir[axis] + first);
            reach = max8(reach, max8(zero - org, org));
            length = max8(length, max8(zero - dir, dir));
        }
        reach = reach + Eight(extent);
        Eight reckoned = at_most8(max8(reach, length), Eight(abi::largest_coordinate));
        reckoned = by_sign(at_most8(Eight(smallest_length), length), zero, reckoned);
        const Eight pad = Eight(slack) * reach;
        for (int axis = 0; axis < 3; ++axis) {
            const Eight org = load8(group.org[axis] + first);
            const Eight dir = load8(group.dir[axis] + first);
            const Eight size = max8(zero - dir, dir);
            const Eight along = at_most8(size, Eight(smallest_component));
            const Eight inv = by_sign(along, Eight(1.0f) / dir, Eight(1.0f / smallest_component));
            const Eight near = by_sign(inv, org + pad, org - pad);
            const Eight far = by_sign(inv, org - pad, org + pad);
            store8(slabs.inv[axis] + first, by_sign(reckoned, Eight(1.0f), inv));
            store8(slabs.near_org[axis] + first, by_sign(reckoned, Eight(open_axis), near * inv));
            store8(slabs.far_org[axis] + first, by_sign(reckoned, Eight(-open_axis), far * inv));
        }
    }
}

/// The active rays of a cell that may meet a box before they end.
template <class Real>
inline std::uint32_t meet_rays(const SlabRays& slabs, const RayGroup<Real>& group, int cell,
                               const float (&low)[3], const float (&high)[3])
{
    const float shorten = sizeof(Real) == sizeof(float) ? 1.0f : 1.000001f;
    std::uint32_t hits = 0;
    for (int part = 0; part < cell_rays; part += 8) {
        const int first = cell * cell_rays + part;
        Eight t_near(0.0f);
        Eight t_far = load8(group.t + first) * Eight(shorten);
        for (int axis = 0; axis < 3; ++axis) {
            const Eight inv = load8(slabs.inv[axis] + first);
            const Eight enter = by_sign(inv, Eight(low[axis]), Eight(high[axis]));
            const Eight leave = by_sign(inv, Eight(high[axis]), Eight(low[axis]));
            t_near = max8(about_msub(enter, inv, load8(slabs.near_org[axis] + first)), t_near);
            t_far = min8(about_msub(leave, inv, load8(slabs.far_org[axis] + first)), t_far);
        }
        hits |= less_equal8(t_near, t_far) << part;
    }
    return hits & group.active[cell];
}

/// Not below `t`, in single precision.
template <class Real>
inline float float_above(Real t)
{
    const float rounded = static_cast<float>(t);
    return sizeof(Real) == sizeof(float) ? rounded : rounded * 1.000001f;
}

/// A ray of a filled cell for a walk of its own.
template <class Real>
inline SlabRay slab_ray(const SlabRays& slabs, const RayGroup<Real>& group, int ray)
{
    SlabRay slab;
    for (int axis = 0; axis < 3; ++axis) {
        slab.inv[axis] = slabs.inv[axis][ray];
        slab.near_org[axis] = slabs.near_org[axis][ray];
        slab.far_org[axis] = slabs.far_org[axis][ray];
        slab.near_row[axis] = slab.inv[axis] < 0.0f ? axis + 3 : axis;
    }
    slab.t_max = float_above(group.t[ray]);
    return slab;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
