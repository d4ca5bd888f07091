#pragma once

#include "kernels/simd/vec3.hpp"

// Loads and stores values of streams that may end within a packet. `count` is the number of values
// left at `from` or `to`; it may be more than a packet. Whole packets of reals are loaded and
// stored at once.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Loads up to a packet of values; lanes beyond `count` repeat the first value.
template <class Real>
inline vreal<Real> load_some(const Real* from, int count)
{
    if (count >= lanes<Real>)
        return load(from);
    alignas(64) Real values[lanes<Real>];
    for (int lane = 0; lane < lanes<Real>; ++lane)
        values[lane] = from[lane < count ? lane : 0];
    return load(values);
}

template <class Real>
inline Vec3v<Real> load_some3(const Real* const (&from)[3], int first, int count)
{
    return {load_some(from[0] + first, count), load_some(from[1] + first, count),
            load_some(from[2] + first, count)};
}

/// Loads up to a packet of 32-bit numbers, widened to the integers of the packet, one by one; lanes
/// beyond `count` repeat the first number.
template <class Real>
inline vint<Real> load_numbers(const std::int32_t* from, int count)
{
    alignas(64) lane_int<Real> values[lanes<Real>];
    for (int lane = 0; lane < lanes<Real>; ++lane)
        values[lane] = from[lane < count ? lane : 0];
    return load(values);
}

template <class Real>
inline void store_some(Real* to, batch<Real> x, int count)
{
    if (count >= lanes<Real>)
        return store(to, x);
    alignas(64) Real values[lanes<Real>];
    store(values, x);
    for (int lane = 0; lane < count; ++lane)
        to[lane] = values[lane];
}

template <class Real>
inline void store_numbers(std::int32_t* to, const vint<Real>& x, int count)
{
    if constexpr (sizeof(Real) == sizeof(float))
        if (count >= lanes<Real>)
            return store(to, x);
    alignas(64) lane_int<Real> values[lanes<Real>];
    store(values, x);
    const int live = count < lanes<Real> ? count : lanes<Real>;
    for (int lane = 0; lane < live; ++lane)
        to[lane] = static_cast<std::int32_t>(values[lane]);
}

/// Stores nothing if the arrays are null.
template <class Real>
inline void store_some3(Real* const (&to)[3], int at, const Vec3v<Real>& v, int count)
{
    if (to[0] == nullptr)
        return;
    store_some(to[0] + at, v.x, count);
    store_some(to[1] + at, v.y, count);
    store_some(to[2] + at, v.z, count);
}

/// Expands eight bits to eight bytes that are 0 or 1, lowest bit first.
inline std::uint64_t bytes_of(std::uint32_t bits)
{
    // The product copies the bits to each byte, and each byte keeps its own bit. Adding 0x7f
    // carries any bit that is set into the byte's top bit.
    const std::uint64_t own = bits * 0x0101010101010101u & 0x8040201008040201u;
    return (own + 0x7f7f7f7f7f7f7f7fu) >> 7 & 0x0101010101010101u;
}

/// Writes one byte per lane, 1 for the lanes in `lanes_of`, else 0.
template <class Real>
inline void store_mask(std::uint8_t* to, std::uint32_t lanes_of, int count)
{
    const int live = count < lanes<Real> ? count : lanes<Real>;
    for (int first = 0; first < live; first += 8) {
        const std::uint64_t bytes = bytes_of(lanes_of >> first & 0xffu);
        const int byte_count = live - first < 8 ? live - first : 8;
        if (byte_count == 8)
            __builtin_memcpy(to + first, &bytes, 8);
        else
            __builtin_memcpy(to + first, &bytes, static_cast<std::size_t>(byte_count));
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
