#pragma once

#include "kernel_abi/bvh_view.hpp"
#include "kernels/bvh/bundle.hpp"
#include "kernels/simd/vfloat8.hpp"

// Interval frustums of the rays of a cell, of a quarter of the bundle (four cells), and of the
// whole bundle: intervals of origins and of reciprocal directions. All bounds are in single
// precision and allow for rounding, whatever the precision of the rays.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline constexpr int first_quarter = bundle_cells;
inline constexpr int whole_bundle = first_quarter + 4;
inline constexpr int frustum_count = 24;  ///< 21, rounded up to whole registers

struct alignas(32) CellBounds {
    float org_low[3][frustum_count];
    float org_high[3][frustum_count];
    float inv_low[3][frustum_count];  ///< same sign as inv_high
    float inv_high[3][frustum_count];
    float t_max[frustum_count];  ///< no ray needs anything beyond
    /// One bit per coherent cell, whose rays run close to each other. The bounds of other cells are
    /// not set.
    std::uint32_t coherent;
};

/// Intervals of one value, over cells, quarters and the whole bundle.
struct CellRange {
    alignas(32) float low[frustum_count];
    alignas(32) float high[frustum_count];
};

inline constexpr float no_end = __builtin_inff();
/// Along an axis that is not bounded, origins are in [-open_axis, open_axis].
inline constexpr float open_axis = 1e30f;
/// Smaller components of directions count as 0, for rays that are at least smallest_length long.
inline constexpr float smallest_component = 1e-18f;
inline constexpr float smallest_length = 1e-12f;

/// The smallest and largest value of each cell's rays. NaN is ignored; a cell without active rays
/// has low > high.
template <class Real>
inline void find_cells(CellRange& range, const Real (&values)[bundle_rays],
                       const RayBundle<Real>& bundle)
{
    const auto least = [](vfloat8 a, vfloat8 b) { return min(a, b); };
    const auto most = [](vfloat8 a, vfloat8 b) { return max(a, b); };
    for (int half = 0; half < 2; ++half) {
        vfloat8 low[8];
        vfloat8 high[8];
        for (int i = 0; i < 8; ++i) {
            const int cell = half * 8 + i;
            low[i] = vfloat8(no_end);
            high[i] = vfloat8(-no_end);
            if (bundle.active[cell] == 0)
                continue;
            for (int part = 0; part < 2; ++part) {
                const vfloat8 value = load8(values + cell * cell_rays + part * 8);
                low[i] = min(value, low[i]);
                high[i] = max(value, high[i]);
            }
        }
        store8(range.low + half * 8, reduce8(low, least));
        store8(range.high + half * 8, reduce8(high, most));
    }
}

/// Sets all intervals to one value.
inline void set_all(CellRange& range, float value)
{
    for (int first = 0; first < frustum_count; first += 8) {
        store8(range.low + first, vfloat8(value));
        store8(range.high + first, vfloat8(value));
    }
}

/// Computes the intervals of quarters and of the whole bundle from those of the cells.
inline void join_cells(CellRange& range)
{
    const auto low_of = [](float a, float b) { return a < b ? a : b; };
    const auto high_of = [](float a, float b) { return a > b ? a : b; };
    const auto join = [&](int to, int from) {
        range.low[to] = low_of(low_of(range.low[from], range.low[from + 1]),
                               low_of(range.low[from + 2], range.low[from + 3]));
        range.high[to] = high_of(high_of(range.high[from], range.high[from + 1]),
                                 high_of(range.high[from + 2], range.high[from + 3]));
    };
    for (int quarter = 0; quarter < 4; ++quarter)
        join(first_quarter + quarter, 4 * quarter);
    join(whole_bundle, first_quarter);
    for (int rest = whole_bundle + 1; rest < frustum_count; ++rest) {
        range.low[rest] = 0.0f;
        range.high[rest] = 0.0f;
    }
}

inline vfloat8 size8(vfloat8 low, vfloat8 high)
{
    return max(vfloat8(0.0f) - low, high);
}

/// The values that all axes share: the largest distance between rays and boxes, and whether the
/// rays have magnitudes that single precision can handle, as sign bits.
struct FrustumScale {
    vfloat8 reach;
    vfloat8 reckoned;
};

inline FrustumScale frustum_scale(const CellRange (&org)[3], const CellRange (&dir)[3],
                                  float extent, int first)
{
    vfloat8 reach(0.0f);
    vfloat8 length(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        reach = max(reach, size8(load8(org[axis].low + first), load8(org[axis].high + first)));
        length = max(length, size8(load8(dir[axis].low + first), load8(dir[axis].high + first)));
    }
    reach = reach + vfloat8(extent);
    const vfloat8 zero(0.0f);
    const vfloat8 large(abi::largest_coordinate);
    vfloat8 reckoned = max(reach, length) <= large;
    reckoned = blend(vfloat8(smallest_length) <= length, zero, reckoned);
    return {reach, reckoned};
}

/// Fills one axis of eight frustums. If the directions of a frustum have both signs along an axis,
/// it is not bounded along that axis. Rays perpendicular to an axis count as nearly so.
inline void set_axis(CellBounds& bounds, int axis, const CellRange& org, const CellRange& dir,
                     const FrustumScale& scale, float slack, int first)
{
    const vfloat8 one(1.0f);
    const vfloat8 tiny(smallest_component);
    const vfloat8 minus_tiny(-smallest_component);
    const vfloat8 low = load8(dir.low + first);
    const vfloat8 high = load8(dir.high + first);
    const vfloat8 along = size8(low, high) <= tiny;
    const vfloat8 against = high <= minus_tiny;
    // Sign bits: the interval of directions does not contain zero.
    vfloat8 one_sided = blend(tiny <= low, against, tiny <= low);
    one_sided = blend(along, one_sided, along);
    const vfloat8 known = blend(scale.reckoned, vfloat8(0.0f), one_sided);

    const vfloat8 steepest(1.0f / smallest_component);
    const vfloat8 pad = vfloat8(slack) * scale.reach;
    const vfloat8 inv_low = blend(along, one / high, steepest);
    const vfloat8 inv_high = blend(along, one / low, steepest);
    const vfloat8 org_low = load8(org.low + first) - pad;
    const vfloat8 org_high = load8(org.high + first) + pad;
    store8(bounds.inv_low[axis] + first, blend(known, one, inv_low));
    store8(bounds.inv_high[axis] + first, blend(known, one, inv_high));
    store8(bounds.org_low[axis] + first, blend(known, vfloat8(-open_axis), org_low));
    store8(bounds.org_high[axis] + first, blend(known, vfloat8(open_axis), org_high));
}

/// The cells with at least one active ray.
template <class Real>
inline std::uint32_t active_cells(const RayBundle<Real>& bundle)
{
    std::uint32_t cells = 0;
    for (int cell = 0; cell < bundle_cells; ++cell)
        cells |= (bundle.active[cell] != 0 ? 1u : 0u) << cell;
    return cells;
}

/// The cells whose directions differ little, and those without active rays, where low > high.
inline std::uint32_t coherent_cells(const CellRange (&dir)[3], float largest_spread)
{
    std::uint32_t coherent = 0;
    for (int first = 0; first < bundle_cells; first += 8) {
        vfloat8 length(0.0f);
        vfloat8 spread(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const vfloat8 low = load8(dir[axis].low + first);
            const vfloat8 high = load8(dir[axis].high + first);
            length = max(length, size8(low, high));
            spread = max(spread, high - low);
        }
        const std::uint32_t reckoned = less_equal8(length, vfloat8(abi::largest_coordinate));
        coherent |= (reckoned & less_equal8(spread, vfloat8(largest_spread) * length)) << first;
    }
    return coherent;
}

inline constexpr std::uint32_t all_cells = (1u << bundle_cells) - 1u;

/// Excludes cells from the quarters and the whole bundle.
inline void leave_out(CellRange& range, std::uint32_t cells)
{
    for (; cells != 0; cells &= cells - 1) {
        const int cell = __builtin_ctz(cells);
        range.low[cell] = no_end;
        range.high[cell] = -no_end;
    }
}

/// The cells of `cells` whose origins are at most `furthest` apart: parallel rays from distant
/// origins hit different boxes.
inline std::uint32_t close_cells(const CellRange (&org)[3], float furthest, std::uint32_t cells)
{
    std::uint32_t close = 0;
    for (int first = 0; first < bundle_cells; first += 8) {
        vfloat8 apart(0.0f);
        for (int axis = 0; axis < 3; ++axis)
            apart = max(apart, load8(org[axis].high + first) - load8(org[axis].low + first));
        close |= less_equal8(apart, vfloat8(furthest)) << first;
    }
    return cells & close;
}

/// How far apart the origins of a coherent cell may be, relative to how far its directions may
/// spread over the extent of the BVH: results/parallel_rays.json.
inline constexpr float origins_apart = 2.0f;

/// Finds the origins of a bundle's cells. Removes cells from bounds.coherent whose origins are too
/// far apart.
template <class Real>
inline void find_origins(CellRange (&org)[3], CellBounds& bounds, const RayBundle<Real>& bundle,
                         float furthest)
{
    for (int axis = 0; axis < 3; ++axis)
        find_cells(org[axis], bundle.org[axis], bundle);
    bounds.coherent = close_cells(org, furthest, bounds.coherent);
    for (int axis = 0; axis < 3; ++axis) {
        leave_out(org[axis], all_cells & ~bounds.coherent);
        join_cells(org[axis]);
    }
}

/// Computes the bounds of a bundle's active rays, for tests against the boxes of a BVH. Cells with
/// at most `spread` (abi::BvhView) are coherent. With `one_origin`, bundle.origin is used.
template <class Real>
inline void bound_cells(CellBounds& bounds, const RayBundle<Real>& bundle,
                        const abi::BvhView<Real>& bvh, float spread, bool one_origin)
{
    CellRange org[3];
    CellRange dir[3];
    for (int axis = 0; axis < 3; ++axis)
        find_cells(dir[axis], bundle.dir[axis], bundle);
    bounds.coherent = active_cells(bundle) & coherent_cells(dir, spread);
    if (bounds.coherent == 0)
        return;
    if (one_origin)
        for (int axis = 0; axis < 3; ++axis)
            set_all(org[axis], bundle.origin[axis]);
    else
        find_origins(org, bounds, bundle, origins_apart * spread * bvh.extent);
    if (bounds.coherent == 0)
        return;
    for (int axis = 0; axis < 3; ++axis) {
        leave_out(dir[axis], all_cells & ~bounds.coherent);
        join_cells(dir[axis]);
    }
    for (int first = 0; first < frustum_count; first += 8) {
        const FrustumScale scale = frustum_scale(org, dir, bvh.extent, first);
        for (int axis = 0; axis < 3; ++axis)
            set_axis(bounds, axis, org[axis], dir[axis], scale, bvh.slack, first);
    }
}

/// Computes the t_max of quarters and of the whole bundle from those of the cells.
inline void join_t_max(CellBounds& bounds)
{
    const auto further = [&](int a, int b) {
        return bounds.t_max[a] > bounds.t_max[b] ? bounds.t_max[a] : bounds.t_max[b];
    };
    for (int quarter = 0; quarter < 4; ++quarter) {
        const float left = further(4 * quarter, 4 * quarter + 1);
        const float right = further(4 * quarter + 2, 4 * quarter + 3);
        bounds.t_max[first_quarter + quarter] = left > right ? left : right;
    }
    const float left = further(first_quarter, first_quarter + 1);
    const float right = further(first_quarter + 2, first_quarter + 3);
    bounds.t_max[whole_bundle] = left > right ? left : right;
}

/// The smallest frustum that contains all cells of `cells`, which is not 0.
inline int frustum_of(std::uint32_t cells)
{
    if ((cells & (cells - 1)) == 0)
        return __builtin_ctz(cells);
    const int quarter = __builtin_ctz(cells) / 4;
    return (cells & ~(0xfu << 4 * quarter)) == 0 ? first_quarter + quarter : whole_bundle;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
