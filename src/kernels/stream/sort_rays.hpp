#pragma once

#include "kernels/geometry/cone.hpp"
#include "kernels/stream/tile_memory.hpp"

// Sorts the rays of one generation of several tiles by the octant of their direction, then by their
// origin. Rays reflected by small or curved mirrors have little in common with their neighbours in
// the picture. Rays that are neighbours after sorting hit more of the same boxes.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A key has three bits for the octant, then the Morton code of the origin's cell; each axis has
/// 2^cell_bits cells.
inline constexpr int cell_bits = 3;
inline constexpr int sort_keys = 8 << 3 * cell_bits;

/// Ray i of stream k has the number k * chunk_rays + i.
using RayNumber = std::uint16_t;
inline constexpr int most_sorted = abi::block_tiles * chunk_rays;
static_assert(most_sorted <= 1 << 16);

template <abi::Features F, class Real>
struct SortedWork {
    RayStream<F, Real>* streams[2];  ///< of this and the next generation, abi::block_tiles each
    RayNumber order[most_sorted];
    std::uint16_t key[most_sorted];
    std::uint16_t next[sort_keys];  ///< while sorting: index of the next ray with a key
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
            // If the box is too small or too large, all rays are in one cell.
            scale[axis] = size > Real(0x1p-100) && size < Real(0x1p100) ? last / size : Real(0);
        }
    }
};

/// The box of the origins of several streams, none of which is empty.
template <abi::Features F, class Real>
inline Box<Real> box_of_streams(const RayStream<F, Real>* streams, int stream_count)
{
    Box<Real> all = box_of(streams->org, streams->count);
    for (int i = 1; i < stream_count; ++i) {
        const Box<Real> box = box_of(streams[i].org, streams[i].count);
        for (int axis = 0; axis < 3; ++axis) {
            all.low[axis] = box.low[axis] < all.low[axis] ? box.low[axis] : all.low[axis];
            all.high[axis] = box.high[axis] > all.high[axis] ? box.high[axis] : all.high[axis];
        }
    }
    return all;
}

/// Puts two zeros between the bits of a number below 2^cell_bits.
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

/// Fills `sorted.order` with the sorted rays of `stream_count` streams, none of them empty; returns
/// the number of rays. It is a counting sort in one pass.
template <abi::Features F, class Real>
inline int sort_rays(SortedWork<F, Real>& sorted, const RayStream<F, Real>* streams,
                     int stream_count)
{
    for (std::uint16_t& next : sorted.next)
        next = 0;
    const SortGrid<Real> grid(box_of_streams(streams, stream_count));
    for (int k = 0; k < stream_count; ++k) {
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
    for (int k = 0; k < stream_count; ++k)
        for (int i = 0; i < streams[k].count; ++i) {
            const int number = k * chunk_rays + i;
            sorted.order[sorted.next[sorted.key[number]]++] = static_cast<RayNumber>(number);
        }
    return rays;
}

/// Copies the rays with `ray_count` numbers, a chunk, to a stream.
template <abi::Features F, class Real>
inline void gather_rays(RayStream<F, Real>& to, const RayStream<F, Real>* streams,
                        const RayNumber* numbers, int ray_count)
{
    for (int i = 0; i < ray_count; ++i) {
        const RayStream<F, Real>& from = streams[numbers[i] / chunk_rays];
        const int ray = numbers[i] % chunk_rays;
        for_each_array<F>(to.starts != nullptr,
                          [&](const auto& array) { array(to)[i] = array(from)[ray]; });
    }
    to.count = ray_count;
    if constexpr (F.probe)
        to.reflected_count = ray_count;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
