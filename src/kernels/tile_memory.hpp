#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/pixels.hpp"

// The working memory of one tile: streams of rays in structure-of-arrays form.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Room for a tile's rays and for one packet written past the last.
inline constexpr int stream_capacity = abi::tile_pixels + abi::padding;

template <class Real>
using StreamArray = Real[stream_capacity];

/// Rays of one generation, in an order that does not depend on the packet width.
template <class Real>
struct alignas(64) RayStream {
    StreamArray<Real> org[3];
    StreamArray<Real> dir[3];
    StreamArray<Real> weight[3];        ///< throughput of the path so far, per channel
    StreamArray<lane_int<Real>> pixel;  ///< number in the tile, along its Z-order curve
    int count = 0;
};

/// The rays of a generation that hit something, where they did.
template <class Real>
struct alignas(64) HitStream {
    StreamArray<Real> point[3];
    StreamArray<Real> dir[3];
    StreamArray<Real> weight[3];
    StreamArray<lane_int<Real>> pixel;
    StreamArray<lane_int<Real>> object;
    int count = 0;
};

template <class Real>
struct alignas(64) TileMemory {
    TilePixelColors<Real> color;
    RayStream<Real> rays;  ///< of the next generation
    HitStream<Real> hits;
};

template <class Real>
inline Vec3v<Real> load3(const StreamArray<Real> (&from)[3], int first)
{
    return {load(from[0] + first), load(from[1] + first), load(from[2] + first)};
}

template <class Real>
inline void append3(StreamArray<Real> (&to)[3], int at, std::uint32_t pattern, const Vec3v<Real>& v)
{
    compress_store(to[0] + at, pattern, v.x);
    compress_store(to[1] + at, pattern, v.y);
    compress_store(to[2] + at, pattern, v.z);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
