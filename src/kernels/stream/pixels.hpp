#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/simd/records.hpp"

#include <cstddef>
#include <utility>

// The pixels of a tile while it is rendered: r, g, b and one unused element each, along the tile's
// Z-order curve, so that a pixel is one load and one store. They are one array, so that whole
// packets of pixels can be moved.
namespace packtrace::PACKTRACE_ISA {
namespace {

constexpr int pixel_elements = 4;

/// Elements of a tile.
constexpr int tile_elements = pixel_elements * abi::tile_pixels;

/// `Count` reals that are moved at once: a vector extension of GCC and Clang. They are copied to
/// and from arrays as bytes, which need no alignment.
template <class Real, int Count>
using Reals [[gnu::vector_size(Count * sizeof(Real))]] = Real;

inline void store_pixels(double* to, vreal<double> r, vreal<double> g, vreal<double> b)
{
    alignas(64) double channel[3][lanes<double>];
    store(channel[0], r);
    store(channel[1], g);
    store(channel[2], b);
    for (int lane = 0; lane < lanes<double>; ++lane, to += 4) {
        to[0] = channel[0][lane];
        to[1] = channel[1][lane];
        to[2] = channel[2][lane];
        to[3] = 0.0;
    }
}

/// How light is written: the first light in a pixel replaces the background, later light is added.
enum class PixelWrite { set, add };

/// Writes a packet of colours to its pixels, in lane order. When adding, `number` may contain a
/// pixel twice.
template <class Real>
inline void write_colors(PixelWrite write, Real* pixels, const vint<Real>& number,
                         const Vec3v<Real>& color, std::uint32_t active)
{
    if (active == 0)
        return;
    alignas(64) lane_int<Real> at[lanes<Real>];
    store(at, number);
    const bool are_neighbours =
        lanes<Real> == 1 ||
        (active == all_lanes<Real> &&
         bits(int_equal(number, lane_numbers<Real>(static_cast<int>(at[0])))) == all_lanes<Real>);
    Real* const block = pixels + pixel_elements * at[0];
    if (write == PixelWrite::set && are_neighbours)
        return store_pixels(block, color.x, color.y, color.z);
    alignas(64) Real colors[pixel_elements * lanes<Real>];
    store_pixels(colors, color.x, color.y, color.z);
    if (write == PixelWrite::add && are_neighbours) {
        for (int i = 0; i < pixel_elements * lanes<Real>; i += lanes<Real>)
            store(block + i, load(block + i) + load(colors + i));
        return;
    }
    for (; active != 0; active &= active - 1) {
        const int lane = __builtin_ctz(active);
        Real* const pixel = pixels + pixel_elements * at[lane];
        Reals<Real, pixel_elements> light;
        __builtin_memcpy(&light, colors + pixel_elements * lane, sizeof light);
        if (write == PixelWrite::add) {
            Reals<Real, pixel_elements> before;
            __builtin_memcpy(&before, pixel, sizeof before);
            light += before;
        }
        __builtin_memcpy(pixel, &light, sizeof light);
    }
}

/// Fills all pixels of a tile with one colour.
template <class Real>
inline void fill_pixels(Real* pixels, const Real (&color)[3])
{
    constexpr int pattern_elements = pixel_elements < lanes<Real> ? lanes<Real> : pixel_elements;
    alignas(64) Real pattern[static_cast<std::size_t>(pattern_elements)];
    const Reals<Real, pixel_elements> pixel{color[0], color[1], color[2], Real(0)};
    for (int i = 0; i < pattern_elements; i += pixel_elements)
        __builtin_memcpy(pattern + i, &pixel, sizeof pixel);
    for (int i = 0; i < tile_elements; i += lanes<Real>)
        store(pixels + i, load(pattern + i % pattern_elements));
}

/// Spreads the low bits of `number` to every second bit.
constexpr int spread_bits(int number)
{
    return (number & 1) | ((number & 2) << 1) | ((number & 4) << 2) | ((number & 8) << 3);
}

/// Writes the channels of two neighbours in a row, the first with an even number, to `to`:
/// `Written` elements, 6 channels and up to two more that the next pixels overwrite. It returns no
/// vector of both pixels, because that is wider than an SSE register and has no fixed ABI.
template <std::size_t Written, class Real>
inline void write_two(Real* to, const Real* pixels)
{
    Reals<Real, 2 * pixel_elements> two;
    __builtin_memcpy(&two, pixels, sizeof two);
    two = __builtin_shufflevector(two, two, 0, 1, 2, 4, 5, 6, 3, 7);
    __builtin_memcpy(to, &two, Written * sizeof(Real));
}

template <class Real>
inline void write_one(Real* to, const Real* pixel)
{
    for (int channel = 0; channel < 3; ++channel)
        to[channel] = pixel[channel];
}

/// Writes a whole row of a tile; `Pair` are all pairs of pixels except the last.
template <class Real, int... Pair>
inline void write_pairs(Real* to, const Real* row, std::integer_sequence<int, Pair...>)
{
    (write_two<2 * pixel_elements>(to + 6 * Pair, row + pixel_elements * spread_bits(2 * Pair)),
     ...);
    constexpr int last = sizeof...(Pair);
    write_two<6>(to + 6 * last, row + pixel_elements * spread_bits(2 * last));
}

/// Writes one row of a tile to `to`, interleaved.
template <class Real>
inline void write_row(Real* to, const Real* pixels, int row, int width)
{
    const Real* const first = pixels + pixel_elements * (spread_bits(row) << 1);
    if (width == abi::tile_size)
        return write_pairs(to, first, std::make_integer_sequence<int, abi::tile_size / 2 - 1>{});
    for (int column = 0; column < width; ++column)
        write_one(to + 3 * column, first + pixel_elements * spread_bits(column));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
