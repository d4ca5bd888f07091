#pragma once

#include "kernels/simd/vec3.hpp"

// Values of streams in and out of packets. Streams end anywhere: `count` tells how many values
// are left at `from` or `to`. Whole packets go in one piece.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Up to a packet of values; lanes beyond `count` repeat the first.
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

/// The same for numbers, which are as wide as reals in packets.
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

/// Nothing where the arrays are not wanted.
template <class Real>
inline void store_some3(Real* const (&to)[3], int at, const Vec3v<Real>& v, int count)
{
    if (to[0] == nullptr)
        return;
    store_some(to[0] + at, v.x, count);
    store_some(to[1] + at, v.y, count);
    store_some(to[2] + at, v.z, count);
}

/// vfloat8 bits as bytes that are 0 or 1, the lowest first.
inline std::uint64_t bytes_of(std::uint32_t bits)
{
    // Each byte keeps its own bit of eight copies; what is not 0 then carries into its top bit.
    const std::uint64_t own = bits * 0x0101010101010101u & 0x8040201008040201u;
    return (own + 0x7f7f7f7f7f7f7f7fu) >> 7 & 0x0101010101010101u;
}

/// Writes a byte a lane, 1 where `lanes_of` has its bit.
template <class Real>
inline void store_mask(std::uint8_t* to, std::uint32_t lanes_of, int count)
{
    const int live = count < lanes<Real> ? count : lanes<Real>;
    for (int first = 0; first < live; first += 8) {
        const std::uint64_t bytes = bytes_of(lanes_of >> first & 0xffu);
        const int size = live - first < 8 ? live - first : 8;
        if (size == 8)
            __builtin_memcpy(to + first, &bytes, 8);
        else
            __builtin_memcpy(to + first, &bytes, static_cast<std::size_t>(size));
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
