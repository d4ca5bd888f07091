#pragma once

#include "kernels/bvh/walk_ray.hpp"

// Tests the single rays of a cell against a box: if boxes are small compared with a cell, few of
// its rays hit them.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A bundle's rays prepared for tests against boxes. Each cell is filled when it is first needed.
struct SlabRays {
    alignas(32) float near_org[3][bundle_rays];  ///< times inv; moved so that boxes seem nearer
    /// Times inv; moved so that boxes seem further away.
    alignas(32) float far_org[3][bundle_rays];
    alignas(32) float inv[3][bundle_rays];  ///< 1 / direction
    std::uint32_t filled = 0;               ///< one bit per cell
};

template <class Real>
inline void fill_cell(SlabRays& slabs, const RayBundle<Real>& bundle, int cell, float extent,
                      float slack)
{
    if (slabs.filled >> cell & 1u)
        return;
    slabs.filled |= 1u << cell;
    const vfloat8 zero(0.0f);
    for (int first = cell * cell_rays; first < (cell + 1) * cell_rays; first += 8) {
        vfloat8 reach(0.0f);
        vfloat8 length(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const vfloat8 org = load8(bundle.org[axis] + first);
            const vfloat8 dir = load8(bundle.dir[axis] + first);
            reach = max(reach, max(zero - org, org));
            length = max(length, max(zero - dir, dir));
        }
        reach = reach + vfloat8(extent);
        vfloat8 reckoned = max(reach, length) <= vfloat8(abi::largest_coordinate);
        reckoned = blend(vfloat8(smallest_length) <= length, zero, reckoned);
        const vfloat8 pad = vfloat8(slack) * reach;
        for (int axis = 0; axis < 3; ++axis) {
            const vfloat8 org = load8(bundle.org[axis] + first);
            const vfloat8 dir = load8(bundle.dir[axis] + first);
            const vfloat8 size = max(zero - dir, dir);
            const vfloat8 along = size <= vfloat8(smallest_component);
            const vfloat8 inv =
                blend(along, vfloat8(1.0f) / dir, vfloat8(1.0f / smallest_component));
            const vfloat8 near = blend(inv, org + pad, org - pad);
            const vfloat8 far = blend(inv, org - pad, org + pad);
            store8(slabs.inv[axis] + first, blend(reckoned, vfloat8(1.0f), inv));
            store8(slabs.near_org[axis] + first, blend(reckoned, vfloat8(open_axis), near * inv));
            store8(slabs.far_org[axis] + first, blend(reckoned, vfloat8(-open_axis), far * inv));
        }
    }
}

/// The active rays of a cell that may hit a box before they end.
template <class Real>
inline std::uint32_t meet_rays(const SlabRays& slabs, const RayBundle<Real>& bundle, int cell,
                               const float (&low)[3], const float (&high)[3])
{
    const float shorten = sizeof(Real) == sizeof(float) ? 1.0f : 1.000001f;
    std::uint32_t hits = 0;
    for (int part = 0; part < cell_rays; part += 8) {
        const int first = cell * cell_rays + part;
        vfloat8 t_near(0.0f);
        vfloat8 t_far = load8(bundle.t + first) * vfloat8(shorten);
        for (int axis = 0; axis < 3; ++axis) {
            const vfloat8 inv = load8(slabs.inv[axis] + first);
            const vfloat8 enter = blend(inv, vfloat8(low[axis]), vfloat8(high[axis]));
            const vfloat8 leave = blend(inv, vfloat8(high[axis]), vfloat8(low[axis]));
            t_near = max(about_msub(enter, inv, load8(slabs.near_org[axis] + first)), t_near);
            t_far = min(about_msub(leave, inv, load8(slabs.far_org[axis] + first)), t_far);
        }
        hits |= less_equal8(t_near, t_far) << part;
    }
    return hits & bundle.active[cell];
}

/// Finds the rays of a bundle's cells that may hit a box. Each cell is filled in `slabs` when it is
/// first needed.
template <class Real>
struct CellRays {
    const abi::BvhView<Real>& bvh;
    SlabRays& slabs;
    const RayBundle<Real>& bundle;

    std::uint32_t operator()(int cell, const float (&low)[3], const float (&high)[3]) const
    {
        fill_cell(slabs, bundle, cell, bvh.extent, bvh.slack);
        return meet_rays(slabs, bundle, cell, low, high);
    }
};

/// `t` in single precision, not rounded down.
template <class Real>
inline float float_above(Real t)
{
    const float rounded = static_cast<float>(t);
    return sizeof(Real) == sizeof(float) ? rounded : rounded * 1.000001f;
}

/// A ray of a filled cell, for its own traversal.
template <class Real>
inline SlabRay slab_ray(const SlabRays& slabs, const RayBundle<Real>& bundle, int ray)
{
    SlabRay slab;
    for (int axis = 0; axis < 3; ++axis) {
        slab.inv[axis] = slabs.inv[axis][ray];
        slab.near_org[axis] = slabs.near_org[axis][ray];
        slab.far_org[axis] = slabs.far_org[axis][ray];
        slab.near_row[axis] = slab.inv[axis] < 0.0f ? axis + 3 : axis;
    }
    slab.t_max = float_above(bundle.t[ray]);
    return slab;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
