#pragma once

#include "kernels/bvh/block_ray.hpp"
#include "kernels/bvh/walk_cells.hpp"
#include "kernels/geometry/kinds.hpp"

// Coherent cells of a bundle and the spheres of leaves, for every kind of search.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The quadratic of the sphere in one slot of a block.
template <class Real>
inline Quadratic<Real> quadratic_of(const abi::SphereBlock<Real>& block, int slot,
                                    const RayPacket<Real>& rays)
{
    const Vec3v<Real> center{vreal<Real>(block.center[0][slot]), vreal<Real>(block.center[1][slot]),
                             vreal<Real>(block.center[2][slot])};
    const Vec3v<Real> o = rays.org - center;
    const Real radius = block.radius[slot];
    const vreal<Real> radius2(radius * (radius < 0 ? -radius : radius));
    return sphere_quadratic<Real>(rays, o, radius2, sphere_constant<Real>(o, radius2));
}

/// The largest `t` of a cell's rays in single precision, not rounded down.
template <class Real>
inline float furthest(const RayBundle<Real>& bundle, int cell)
{
    const Real* t = bundle.t + cell * cell_rays;
    const float most = largest_of8(max(load8(t), load8(t + 8)));
    return sizeof(Real) == sizeof(float) ? most : most * 1.000001f;
}

/// Sets the ends of the coherent cells' rays from the bundle; the rays of other cells hit nothing.
template <class Real>
inline void start_coherent(CellBounds& bounds, const RayBundle<Real>& bundle)
{
    for (int cell = 0; cell < bundle_cells; ++cell)
        bounds.t_max[cell] = bounds.coherent >> cell & 1u ? furthest(bundle, cell) : -no_end;
    join_t_max(bounds);
}

/// Calls `visit(slot, cell)` for the spheres of a block and the cells of `cells` that may hit them.
template <class Real, class Visit>
inline void visit_spheres(const CellBounds& bounds, const abi::SphereBlock<Real>& block,
                          std::uint32_t cells, const Visit& visit)
{
    const EightBoxes boxes = boxes_of(block);
    std::uint32_t met = meet_boxes(bounds, frustum_of(cells), boxes).hits;
    if ((cells & (cells - 1)) == 0) {
        for (; met != 0; met &= met - 1)
            visit(__builtin_ctz(met), __builtin_ctz(cells));
        return;
    }
    alignas(32) float low[3][8];
    alignas(32) float high[3][8];
    for (int axis = 0; axis < 3; ++axis) {
        store8(low[axis], boxes.low[axis]);
        store8(high[axis], boxes.high[axis]);
    }
    for (; met != 0; met &= met - 1) {
        const int slot = __builtin_ctz(met);
        std::uint32_t by = meet_cells(bounds, {low[0][slot], low[1][slot], low[2][slot]},
                                      {high[0][slot], high[1][slot], high[2][slot]}, cells);
        for (; by != 0; by &= by - 1)
            visit(slot, __builtin_ctz(by));
    }
}

/// The error bounds of a block's spheres for the rays of a bundle, side by side. They are computed
/// when first needed.
class BlockBounds {
public:
    BlockBounds(const RayBundle<float>& bundle, const abi::SphereBlock<float>& block)
        : bundle_(bundle), block_(block)
    {
    }

    /// Computes them. Must be called before any other function.
    void need()
    {
        if (!is_set_)
            set();
    }

    /// The origins of a packet of the bundle relative to the sphere in one slot.
    [[nodiscard]] Vec3v<float> from_center(int slot, const RayPacket<float>& rays) const
    {
        return rays.org - Vec3v<float>{vreal<float>(block_.center[0][slot]),
                                       vreal<float>(block_.center[1][slot]),
                                       vreal<float>(block_.center[2][slot])};
    }

    [[nodiscard]] vreal<float> outer2(int slot) const
    {
        return vreal<float>(bounds_.outer2[slot]);
    }

    /// `w` is from_center().
    [[nodiscard]] SphereTest test(int slot, const Vec3v<float>& w) const
    {
        const auto all = [slot](const float* values) { return vreal<float>(values[slot]); };
        return {w,
                all(radius2_),
                {all(bounds_.outer2), all(bounds_.inner2), all(bounds_.along), all(bounds_.moment),
                 all(bounds_.size), all(bounds_.band2), all(bounds_.reach)}};
    }

private:
    void set()
    {
        for (int first = 0; first < abi::node_width; first += lanes<float>) {
            const vreal<float> radius = load_of_block(block_.radius, first);
            const SphereBounds<vreal<float>> bounds = leaf_bounds(bundle_, radius);
            store(radius2_ + first, radius * radius);
            store(bounds_.outer2 + first, bounds.outer2);
            store(bounds_.inner2 + first, bounds.inner2);
            store(bounds_.along + first, bounds.along);
            store(bounds_.moment + first, bounds.moment);
            store(bounds_.size + first, bounds.size);
            store(bounds_.band2 + first, bounds.band2);
            store(bounds_.reach + first, bounds.reach);
        }
        is_set_ = true;
    }

    /// The larger of a block and a packet.
    static constexpr int value_count =
        lanes<float> > abi::node_width ? lanes<float> : abi::node_width;
    using Values = float[value_count];

    const RayBundle<float>& bundle_;
    const abi::SphereBlock<float>& block_;
    bool is_set_ = false;
    alignas(64) Values radius2_;
    alignas(64) SphereBounds<Values> bounds_;
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
