#pragma once

#include "kernels/simd/lanes.hpp"
#include "kernels/simd/native/permutations.hpp"

#include <immintrin.h>

// What xsimd lacks, or names differently between versions, in AVX2 and FMA3 instructions.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline vreal<float> madd(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return _mm256_fmadd_ps(a, b, c);
}
inline vreal<double> madd(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return _mm256_fmadd_pd(a, b, c);
}
inline vreal<float> msub(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return _mm256_fmsub_ps(a, b, c);
}
inline vreal<double> msub(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return _mm256_fmsub_pd(a, b, c);
}
inline vreal<float> nmadd(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return _mm256_fnmadd_ps(a, b, c);
}
inline vreal<double> nmadd(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return _mm256_fnmadd_pd(a, b, c);
}

inline std::uint32_t bits(vmask<float> m)
{
    return static_cast<std::uint32_t>(_mm256_movemask_ps(m));
}
inline std::uint32_t bits(vmask<double> m)
{
    return static_cast<std::uint32_t>(_mm256_movemask_pd(m));
}

inline vmask<float> int_equal(vint<float> i, vint<float> j)
{
    return _mm256_castsi256_ps(_mm256_cmpeq_epi32(i, j));
}
inline vmask<double> int_equal(vint<double> i, vint<double> j)
{
    return _mm256_castsi256_pd(_mm256_cmpeq_epi64(i, j));
}
inline vmask<float> int_less(vint<float> i, vint<float> j)
{
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(j, i));
}
inline vmask<double> int_less(vint<double> i, vint<double> j)
{
    return _mm256_castsi256_pd(_mm256_cmpgt_epi64(j, i));
}

template <class Real>
vmask<Real> from_bits(std::uint32_t pattern);
template <>
inline vmask<float> from_bits<float>(std::uint32_t pattern)
{
    const __m256i lane_bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i chosen = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(pattern)), lane_bit);
    return _mm256_castsi256_ps(_mm256_cmpeq_epi32(chosen, lane_bit));
}
template <>
inline vmask<double> from_bits<double>(std::uint32_t pattern)
{
    const __m256i lane_bit = _mm256_setr_epi64x(1, 2, 4, 8);
    const __m256i chosen = _mm256_and_si256(_mm256_set1_epi64x(pattern), lane_bit);
    return _mm256_castsi256_pd(_mm256_cmpeq_epi64(chosen, lane_bit));
}

/// Stores r, g, b, 0 of every lane, in lane order.
inline void store_pixels(float* to, vreal<float> r, vreal<float> g, vreal<float> b)
{
    const __m256 zero = _mm256_setzero_ps();
    const __m256d rg_low = _mm256_castps_pd(_mm256_unpacklo_ps(r, g));
    const __m256d rg_high = _mm256_castps_pd(_mm256_unpackhi_ps(r, g));
    const __m256d b_low = _mm256_castps_pd(_mm256_unpacklo_ps(b, zero));
    const __m256d b_high = _mm256_castps_pd(_mm256_unpackhi_ps(b, zero));
    // Each register holds the pixels of lanes l and l + 4. Then 128-bit halves are exchanged.
    const __m256 first = _mm256_castpd_ps(_mm256_unpacklo_pd(rg_low, b_low));
    const __m256 second = _mm256_castpd_ps(_mm256_unpackhi_pd(rg_low, b_low));
    const __m256 third = _mm256_castpd_ps(_mm256_unpacklo_pd(rg_high, b_high));
    const __m256 fourth = _mm256_castpd_ps(_mm256_unpackhi_pd(rg_high, b_high));
    _mm256_storeu_ps(to, _mm256_permute2f128_ps(first, second, 0x20));
    _mm256_storeu_ps(to + 8, _mm256_permute2f128_ps(third, fourth, 0x20));
    _mm256_storeu_ps(to + 16, _mm256_permute2f128_ps(first, second, 0x31));
    _mm256_storeu_ps(to + 24, _mm256_permute2f128_ps(third, fourth, 0x31));
}

/// 1 / sqrt(x) within 1.5 2^-12.
inline vreal<float> estimate_inverse_sqrt(vreal<float> x)
{
    return _mm256_rsqrt_ps(x);
}

inline vreal<double> widen_low(vreal<float> x)
{
    return _mm256_cvtps_pd(_mm256_castps256_ps128(x));
}
inline vreal<double> widen_high(vreal<float> x)
{
    return _mm256_cvtps_pd(_mm256_extractf128_ps(x, 1));
}
inline vreal<float> narrow(vreal<double> low, vreal<double> high)
{
    return _mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low));
}

constexpr CompressTable<8, 1> compress_singles;
constexpr CompressTable<4, 2> compress_doubles;

inline __m256i lane_order(const std::uint8_t* order)
{
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(order)));
}
inline vreal<float> compress(std::uint32_t pattern, vreal<float> x)
{
    return _mm256_permutevar8x32_ps(x, lane_order(compress_singles.part[pattern]));
}
inline vreal<double> compress(std::uint32_t pattern, vreal<double> x)
{
    const __m256i order = lane_order(compress_doubles.part[pattern]);
    return _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(x), order));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
