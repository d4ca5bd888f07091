#pragma once

#include "kernels/geometry/cone.hpp"
#include "kernels/stream/tile_memory.hpp"

// Rays of one generation of several tiles, sorted by the octant of their direction and then by
// where they start: rays of mirrors that are small, or curved, have little in common with their
// neighbours in the picture. Those sorted next to each other meet more of the same boxes.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Keys are an octant's three bits and Morton's order of cells, each axis cut in 2^cell_bits.
inline constexpr int cell_bits = 3;
inline constexpr int sort_keys = 8 << 3 * cell_bits;

/// Ray i of stream k has the number k * chunk_rays + i.
using RayNumber = std::uint16_t;
inline constexpr int most_sorted = abi::block_tiles * chunk_rays;
static_assert(most_sorted <= 1 << 16);

template <abi::Features F, class Real>
struct SortedWork {
    RayStream<F, Real>* streams[2];  ///< of this generation and the next, abi::block_tiles each
    RayNumber order[most_sorted];
    std::uint16_t key[most_sorted];
    std::uint16_t next[sort_keys];  ///< place of the next ray with a key, while they are sorted
};

/// Maps coordinates to cells.
template <class Real>
struct SortGrid {
    Real low[3];
    Real scale[3];

    SortGrid(const Box<Real>& box)
    {
        constexpr Real last = (1 << cell_bits) - 1;
        for (int axis = 0; axis < 3; ++axis) {
            const Real size = box.high[axis] - box.low[axis];
            low[axis] = box.low[axis];
            // Nothing is to be told apart in what is too small or too large.
            scale[axis] = size > Real(0x1p-100) && size < Real(0x1p100) ? last / size : Real(0);
        }
    }
};

/// None of the streams is empty.
template <abi::Features F, class Real>
inline Box<Real> box_of_streams(const RayStream<F, Real>* streams, int count)
{
    Box<Real> all = box_of(streams->org, streams->count);
    for (int i = 1; i < count; ++i) {
        const Box<Real> box = box_of(streams[i].org, streams[i].count);
        for (int axis = 0; axis < 3; ++axis) {
            all.low[axis] = box.low[axis] < all.low[axis] ? box.low[axis] : all.low[axis];
            all.high[axis] = box.high[axis] > all.high[axis] ? box.high[axis] : all.high[axis];
        }
    }
    return all;
}

/// A number below 2^cell_bits with two zeros between its bits.
template <class Real>
inline vint<Real> spread_cell(const vint<Real>& cell)
{
    vint<Real> spread(lane_int<Real>(0));
    for (int bit = 0; bit < cell_bits; ++bit)
        spread = spread | ((cell & vint<Real>(lane_int<Real>(1 << bit))) << (2 * bit));
    return spread;
}

template <class Real>
inline vint<Real> sort_key(const SortGrid<Real>& grid, const Vec3v<Real>& org,
                           const Vec3v<Real>& dir)
{
    const vreal<Real> x[3] = {org.x, org.y, org.z};
    const vreal<Real> d[3] = {dir.x, dir.y, dir.z};
    vint<Real> key(lane_int<Real>(0));
    for (int axis = 0; axis < 3; ++axis) {
        const vint<Real> cell =
            to_int<Real>((x[axis] - vreal<Real>(grid.low[axis])) * vreal<Real>(grid.scale[axis]));
        const vint<Real> backwards(lane_int<Real>(1 << (3 * cell_bits + axis)));
        key = key | (spread_cell<Real>(cell) << axis) |
              select(d[axis] < vreal<Real>(Real(0)), backwards, vint<Real>(lane_int<Real>(0)));
    }
    return key;
}

/// Fills `sorted.order` with the rays of `count` streams, none of them empty; returns how many
/// there are. A sort by counting, in one pass.
template <abi::Features F, class Real>
inline int sort_rays(SortedWork<F, Real>& sorted, const RayStream<F, Real>* streams, int count)
{
    for (std::uint16_t& next : sorted.next)
        next = 0;
    const SortGrid<Real> grid(box_of_streams(streams, count));
    for (int k = 0; k < count; ++k) {
        std::uint16_t* const key = sorted.key + k * chunk_rays;
        for (int first = 0; first < streams[k].count; first += lanes<Real>) {
            alignas(64) lane_int<Real> keys[lanes<Real>];
            store(keys,
                  sort_key<Real>(grid, load3(streams[k].org, first), load3(streams[k].dir, first)));
            for (int lane = 0; lane < lanes<Real>; ++lane)
                key[first + lane] = static_cast<std::uint16_t>(keys[lane]);
        }
        for (int i = 0; i < streams[k].count; ++i)
            ++sorted.next[key[i]];
    }
    int rays = 0;
    for (std::uint16_t& next : sorted.next) {
        const int same = next;
        next = static_cast<std::uint16_t>(rays);
        rays += same;
    }
    for (int k = 0; k < count; ++k)
        for (int i = 0; i < streams[k].count; ++i) {
            const int number = k * chunk_rays + i;
            sorted.order[sorted.next[sorted.key[number]]++] = static_cast<RayNumber>(number);
        }
    return rays;
}

/// Those of `count` numbers, a chunk.
template <abi::Features F, class Real>
inline void gather_rays(RayStream<F, Real>& to, const RayStream<F, Real>* streams,
                        const RayNumber* numbers, int count)
{
    for (int i = 0; i < count; ++i) {
        const RayStream<F, Real>& from = streams[numbers[i] / chunk_rays];
        const int ray = numbers[i] % chunk_rays;
        for_each_array<F>(to.starts != nullptr,
                          [&](const auto& array) { array(to)[i] = array(from)[ray]; });
    }
    to.count = count;
    if constexpr (F.probe)
        to.mirrored = count;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
