#pragma once

#include "kernel_abi/bvh.hpp"
#include "kernels/eight.hpp"
#include "kernels/ray_group.hpp"

// Intervals that hold the rays of a cell, of a quarter of the group (four cells) and of the
// whole: of their origins, and of the reciprocals of their directions. All bounds are in single
// precision with room for rounding, whatever the rays are in.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline constexpr int first_quarter = group_cells;
inline constexpr int whole_group = first_quarter + 4;
inline constexpr int beam_count = 24;  ///< 21, and room for whole registers

struct alignas(32) CellBounds {
    float org_low[3][beam_count];
    float org_high[3][beam_count];
    float inv_low[3][beam_count];  ///< of the same sign as inv_high
    float inv_high[3][beam_count];
    float t_max[beam_count];  ///< nothing further matters to any ray
    /// A bit for each cell with rays that run close to each other's way; the bounds of the others
    /// are not set.
    std::uint32_t coherent;
};

/// Intervals of one quantity over cells, quarters and all.
struct CellRange {
    alignas(32) float low[beam_count];
    alignas(32) float high[beam_count];
};

inline constexpr float no_end = __builtin_inff();
/// An axis along which nothing is known has its origins in [-open_axis, open_axis].
inline constexpr float open_axis = 1e30f;
/// Components of directions smaller than this are as good as 0 for rays at least that long.
inline constexpr float smallest_component = 1e-18f;
inline constexpr float smallest_length = 1e-12f;

/// The least and largest value of each cell's rays; NaN is left out, a cell without any rays is
/// inside out.
template <class Real>
inline void find_cells(CellRange& range, const Real (&values)[group_rays],
                       const RayGroup<Real>& group)
{
    const auto least = [](Eight a, Eight b) { return min8(a, b); };
    const auto most = [](Eight a, Eight b) { return max8(a, b); };
    for (int half = 0; half < 2; ++half) {
        Eight low[8];
        Eight high[8];
        for (int i = 0; i < 8; ++i) {
            const int cell = half * 8 + i;
            low[i] = Eight(no_end);
            high[i] = Eight(-no_end);
            if (group.active[cell] == 0)
                continue;
            for (int part = 0; part < 2; ++part) {
                const Eight value = load8(values + cell * cell_rays + part * 8);
                low[i] = min8(value, low[i]);
                high[i] = max8(value, high[i]);
            }
        }
        store8(range.low + half * 8, reduce8(low, least));
        store8(range.high + half * 8, reduce8(high, most));
    }
}

/// Quarters and the whole from the cells.
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
    join(whole_group, first_quarter);
    for (int rest = whole_group + 1; rest < beam_count; ++rest) {
        range.low[rest] = 0.0f;
        range.high[rest] = 0.0f;
    }
}

inline Eight size8(Eight low, Eight high)
{
    return max8(Eight(0.0f) - low, high);
}

/// What is the same along all axes: how far rays and boxes are apart at most, and whether the
/// rays are of a size that single precision reckons with. Sign bits say so.
struct BeamScale {
    Eight reach;
    Eight reckoned;
};

inline BeamScale beam_scale(const CellRange (&org)[3], const CellRange (&dir)[3], float extent,
                            int first)
{
    Eight reach(0.0f);
    Eight length(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        reach = max8(reach, size8(load8(org[axis].low + first), load8(org[axis].high + first)));
        length = max8(length, size8(load8(dir[axis].low + first), load8(dir[axis].high + first)));
    }
    reach = reach + Eight(extent);
    const Eight zero(0.0f);
    const Eight large(abi::largest_coordinate);
    Eight reckoned = at_most8(max8(reach, length), large);
    reckoned = by_sign(at_most8(Eight(smallest_length), length), zero, reckoned);
    return {reach, reckoned};
}

/// Fills one axis of eight beams. Rays on both sides of an axis leave it open; those along it
/// are treated as all but along it.
inline void set_axis(CellBounds& bounds, int axis, const CellRange& org, const CellRange& dir,
                     const BeamScale& scale, float slack, int first)
{
    const Eight one(1.0f);
    const Eight tiny(smallest_component);
    const Eight minus_tiny(-smallest_component);
    const Eight low = load8(dir.low + first);
    const Eight high = load8(dir.high + first);
    const Eight along = at_most8(size8(low, high), tiny);
    const Eight against = at_most8(high, minus_tiny);
    // Sign bits: the interval of directions is on one side of zero.
    Eight one_sided = by_sign(at_most8(tiny, low), against, at_most8(tiny, low));
    one_sided = by_sign(along, one_sided, along);
    const Eight known = by_sign(scale.reckoned, Eight(0.0f), one_sided);

    const Eight steepest(1.0f / smallest_component);
    const Eight pad = Eight(slack) * scale.reach;
    const Eight inv_low = by_sign(along, one / high, steepest);
    const Eight inv_high = by_sign(along, one / low, steepest);
    const Eight org_low = load8(org.low + first) - pad;
    const Eight org_high = load8(org.high + first) + pad;
    store8(bounds.inv_low[axis] + first, by_sign(known, one, inv_low));
    store8(bounds.inv_high[axis] + first, by_sign(known, one, inv_high));
    store8(bounds.org_low[axis] + first, by_sign(known, Eight(-open_axis), org_low));
    store8(bounds.org_high[axis] + first, by_sign(known, Eight(open_axis), org_high));
}

/// Which cells bounds are wanted of.
enum class Cells { coherent, all };

/// The cells with any active ray.
template <class Real>
inline std::uint32_t active_cells(const RayGroup<Real>& group)
{
    std::uint32_t cells = 0;
    for (int cell = 0; cell < group_cells; ++cell)
        cells |= (group.active[cell] != 0 ? 1u : 0u) << cell;
    return cells;
}

/// Those whose directions differ little; and those without rays, whose bounds are inside out.
inline std::uint32_t coherent_cells(const CellRange (&dir)[3], float largest_spread)
{
    std::uint32_t coherent = 0;
    for (int first = 0; first < group_cells; first += 8) {
        Eight length(0.0f);
        Eight spread(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const Eight low = load8(dir[axis].low + first);
            const Eight high = load8(dir[axis].high + first);
            length = max8(length, size8(low, high));
            spread = max8(spread, high - low);
        }
        const std::uint32_t reckoned = less_equal8(length, Eight(abi::largest_coordinate));
        coherent |= (reckoned & less_equal8(spread, Eight(largest_spread) * length)) << first;
    }
    return coherent;
}

/// Leaves cells out of the quarters and the whole.
inline void leave_out(CellRange& range, std::uint32_t cells)
{
    for (; cells != 0; cells &= cells - 1) {
        const int cell = __builtin_ctz(cells);
        range.low[cell] = no_end;
        range.high[cell] = -no_end;
    }
}

/// The bounds of a group's active rays, to meet the boxes of a hierarchy. Cells are coherent up to
/// `spread` (abi::BvhView).
template <class Real>
inline void bound_cells(CellBounds& bounds, const RayGroup<Real>& group,
                        const abi::BvhView<Real>& tree, float spread,
                        Cells wanted = Cells::coherent)
{
    CellRange org[3];
    CellRange dir[3];
    for (int axis = 0; axis < 3; ++axis)
        find_cells(dir[axis], group.dir[axis], group);
    bounds.coherent = active_cells(group);
    if (wanted == Cells::coherent)
        bounds.coherent &= coherent_cells(dir, spread);
    if (bounds.coherent == 0)
        return;
    const std::uint32_t others = ~bounds.coherent & ((1u << group_cells) - 1u);
    for (int axis = 0; axis < 3; ++axis) {
        find_cells(org[axis], group.org[axis], group);
        leave_out(org[axis], others);
        leave_out(dir[axis], others);
        join_cells(org[axis]);
        join_cells(dir[axis]);
    }
    for (int first = 0; first < beam_count; first += 8) {
        const BeamScale scale = beam_scale(org, dir, tree.extent, first);
        for (int axis = 0; axis < 3; ++axis)
            set_axis(bounds, axis, org[axis], dir[axis], scale, tree.slack, first);
    }
}

/// Quarters' and the whole group's t_max from the cells'.
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
    bounds.t_max[whole_group] = left > right ? left : right;
}

/// The smallest of the beams above that holds all cells of `cells`, which is not 0.
inline int beam_of(std::uint32_t cells)
{
    if ((cells & (cells - 1)) == 0)
        return __builtin_ctz(cells);
    const int quarter = __builtin_ctz(cells) / 4;
    return (cells & ~(0xfu << 4 * quarter)) == 0 ? first_quarter + quarter : whole_group;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
