#pragma once

#if defined(__x86_64__)
#include "kernels/simd/native/permutations.hpp"

#include <immintrin.h>
#else
#include "kernels/simd/lanes.hpp"
#endif

// Copies ray numbers, which are bytes. On x86 a table and a shuffle instruction move eight at once.
namespace packtrace::PACKTRACE_ISA {
namespace {

#if defined(__x86_64__)

/// Up to this many bytes after the last ray may be overwritten.
inline constexpr int copy_step = 8;

constexpr CompressTable<copy_step, 1> chosen_bytes;

inline __m128i load_bytes(const std::uint8_t* from)
{
    return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
}

/// Copies the `rays` that have a bit for `slot` in `met`; returns their number.
inline int copy_rays(std::uint8_t* to, const std::uint8_t* rays, const std::uint8_t* met, int count,
                     int slot)
{
    const __m128i to_sign = _mm_cvtsi32_si128(7 - slot);
    int copied = 0;
    for (int first = 0; first < count; first += copy_step) {
        const int absent = count - first < copy_step ? copy_step - (count - first) : 0;
        const auto signs = static_cast<std::uint32_t>(
            _mm_movemask_epi8(_mm_sll_epi16(load_bytes(met + first), to_sign)));
        const std::uint32_t chosen = signs & (0xffu >> absent);
        const __m128i moved =
            _mm_shuffle_epi8(load_bytes(rays + first), load_bytes(chosen_bytes.part[chosen]));
        _mm_storel_epi64(reinterpret_cast<__m128i*>(to + copied), moved);
        copied += __builtin_popcount(chosen);
    }
    return copied;
}

#else

/// Up to this many bytes after the last ray may be overwritten.
inline constexpr int copy_step = 1;

/// Copies the `rays` that have a bit for `slot` in `met`; returns their number.
inline int copy_rays(std::uint8_t* to, const std::uint8_t* rays, const std::uint8_t* met, int count,
                     int slot)
{
    int copied = 0;
    for (int i = 0; i < count; ++i) {
        to[copied] = rays[i];
        copied += met[i] >> slot & 1;
    }
    return copied;
}

#endif

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
