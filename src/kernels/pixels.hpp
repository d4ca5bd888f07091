#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/records.hpp"

// The pixels of a tile while it is rendered: r, g, b and one unused element each, along the
// tile's Z-order curve, so that a pixel is one load and one store.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
using TilePixelColors = Real[abi::tile_pixels][4];

/// Four reals moved at once; a vector extension of both compilers.
template <class Real>
struct Pixel {
    using type [[gnu::vector_size(4 * sizeof(Real)), gnu::aligned(alignof(Real)), gnu::may_alias]] =
        Real;

    static type& at(Real* pixel)
    {
        return *reinterpret_cast<type*>(pixel);
    }
    static const type& at(const Real* pixel)
    {
        return *reinterpret_cast<const type*>(pixel);
    }
};

/// Where store_pixels puts a lane.
template <class Real>
constexpr int pixel_slot(int lane)
{
    if constexpr (sizeof(Real) == sizeof(float))
        return lane % 4 * (lanes<Real> / 4) + lane / 4;
    else
        return lane;
}

inline void store_pixels(double (*to)[4], vreal<double> r, vreal<double> g, vreal<double> b)
{
    alignas(64) double channel[3][lanes<double>];
    store(channel[0], r);
    store(channel[1], g);
    store(channel[2], b);
    for (int lane = 0; lane < lanes<double>; ++lane) {
        to[lane][0] = channel[0][lane];
        to[lane][1] = channel[1][lane];
        to[lane][2] = channel[2][lane];
        to[lane][3] = 0.0;
    }
}

/// A packet's first light in a pixel replaces the background there; later light is added.
enum class PixelWrite { set, add };

/// Puts a packet of colours into its pixels in lane order. `number` may name a pixel twice
/// when adding.
template <PixelWrite Write, class Real>
inline void write_colors(TilePixelColors<Real>& pixels, const vint<Real>& number,
                         const Vec3v<Real>& color, std::uint32_t active)
{
    alignas(64) lane_int<Real> at[lanes<Real>];
    alignas(64) Real colors[lanes<Real>][4];
    store(at, number);
    store_pixels(colors, color.x, color.y, color.z);
    for (; active != 0; active &= active - 1) {
        const int lane = __builtin_ctz(active);
        auto& pixel = Pixel<Real>::at(pixels[at[lane]]);
        const auto& light = Pixel<Real>::at(colors[pixel_slot<Real>(lane)]);
        pixel = Write == PixelWrite::set ? light : pixel + light;
    }
}

template <class Real>
inline void fill_pixels(TilePixelColors<Real>& pixels, const Real (&color)[3])
{
    alignas(64) Real pattern[4 * lanes<Real>];
    for (int i = 0; i < 4 * lanes<Real>; ++i)
        pattern[i] = i % 4 < 3 ? color[i % 4] : Real(0);
    const vreal<Real> values = load(pattern);
    constexpr int step = lanes<Real> >= 4 ? lanes<Real> : 2;
    const vreal<Real> more = load(pattern + step % 4);
    for (int i = 0; i < 4 * abi::tile_pixels; i += 2 * step) {
        store(pixels[0] + i, values);
        store(pixels[0] + i + step, more);
    }
}

/// Every second bit position of `number` filled from its low bits.
constexpr int spread_bits(int number)
{
    return (number & 1) | ((number & 2) << 1) | ((number & 4) << 2) | ((number & 8) << 3);
}

struct ColumnOrder {
    std::uint8_t number[abi::tile_size] = {};

    constexpr ColumnOrder()
    {
        for (int column = 0; column < abi::tile_size; ++column)
            number[column] = static_cast<std::uint8_t>(spread_bits(column));
    }
};

constexpr ColumnOrder column_order;

/// One row of a tile into `to`, interleaved. Each pixel is stored with its unused element, which
/// the next one overwrites; the last goes element by element.
template <class Real>
inline void write_row(Real* to, const TilePixelColors<Real>& pixels, int row, int width)
{
    const int row_bits = spread_bits(row) << 1;
    for (int column = 0; column < width - 1; ++column, to += 3)
        Pixel<Real>::at(to) = Pixel<Real>::at(pixels[row_bits | column_order.number[column]]);
    const Real* last = pixels[row_bits | column_order.number[width - 1]];
    to[0] = last[0];
    to[1] = last[1];
    to[2] = last[2];
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
