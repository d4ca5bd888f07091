#pragma once

#include "kernels/simd/lanes.hpp"
#include "kernels/simd/native/permutations.hpp"

#include <immintrin.h>

// What xsimd lacks, in SSE4.2 instructions, with FMA if the object is compiled for it.
namespace packtrace::PACKTRACE_ISA {
namespace {

#if defined(__FMA__)
inline vreal<float> madd(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return _mm_fmadd_ps(a, b, c);
}
inline vreal<double> madd(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return _mm_fmadd_pd(a, b, c);
}
inline vreal<float> msub(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return _mm_fmsub_ps(a, b, c);
}
inline vreal<double> msub(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return _mm_fmsub_pd(a, b, c);
}
inline vreal<float> nmadd(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return _mm_fnmadd_ps(a, b, c);
}
inline vreal<double> nmadd(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return _mm_fnmadd_pd(a, b, c);
}
#else
template <class Real>
inline xsimd::batch<Real, Arch> madd(xsimd::batch<Real, Arch> a, xsimd::batch<Real, Arch> b,
                                     xsimd::batch<Real, Arch> c)
{
    return a * b + c;
}
template <class Real>
inline xsimd::batch<Real, Arch> msub(xsimd::batch<Real, Arch> a, xsimd::batch<Real, Arch> b,
                                     xsimd::batch<Real, Arch> c)
{
    return a * b - c;
}
template <class Real>
inline xsimd::batch<Real, Arch> nmadd(xsimd::batch<Real, Arch> a, xsimd::batch<Real, Arch> b,
                                      xsimd::batch<Real, Arch> c)
{
    return c - a * b;
}
#endif

inline std::uint32_t bits(vmask<float> m)
{
    return static_cast<std::uint32_t>(_mm_movemask_ps(m));
}
inline std::uint32_t bits(vmask<double> m)
{
    return static_cast<std::uint32_t>(_mm_movemask_pd(m));
}

inline vmask<float> int_equal(vint<float> i, vint<float> j)
{
    return _mm_castsi128_ps(_mm_cmpeq_epi32(i, j));
}
inline vmask<double> int_equal(vint<double> i, vint<double> j)
{
    return _mm_castsi128_pd(_mm_cmpeq_epi64(i, j));
}
inline vmask<float> int_less(vint<float> i, vint<float> j)
{
    return _mm_castsi128_ps(_mm_cmpgt_epi32(j, i));
}
inline vmask<double> int_less(vint<double> i, vint<double> j)
{
    return _mm_castsi128_pd(_mm_cmpgt_epi64(j, i));
}

template <class Real>
vmask<Real> from_bits(std::uint32_t pattern);
template <>
inline vmask<float> from_bits<float>(std::uint32_t pattern)
{
    const __m128i lane_bit = _mm_setr_epi32(1, 2, 4, 8);
    const __m128i chosen = _mm_and_si128(_mm_set1_epi32(static_cast<int>(pattern)), lane_bit);
    return _mm_castsi128_ps(_mm_cmpeq_epi32(chosen, lane_bit));
}
template <>
inline vmask<double> from_bits<double>(std::uint32_t pattern)
{
    const __m128i lane_bit = _mm_set_epi64x(2, 1);
    const __m128i chosen = _mm_and_si128(_mm_set1_epi64x(pattern), lane_bit);
    return _mm_castsi128_pd(_mm_cmpeq_epi64(chosen, lane_bit));
}

/// Stores r, g, b, 0 of every lane, in lane order.
inline void store_pixels(float* to, vreal<float> r, vreal<float> g, vreal<float> b)
{
    const __m128 zero = _mm_setzero_ps();
    const __m128 rg_low = _mm_unpacklo_ps(r, g);
    const __m128 rg_high = _mm_unpackhi_ps(r, g);
    const __m128 b_low = _mm_unpacklo_ps(b, zero);
    const __m128 b_high = _mm_unpackhi_ps(b, zero);
    _mm_storeu_ps(to, _mm_movelh_ps(rg_low, b_low));
    _mm_storeu_ps(to + 4, _mm_movehl_ps(b_low, rg_low));
    _mm_storeu_ps(to + 8, _mm_movelh_ps(rg_high, b_high));
    _mm_storeu_ps(to + 12, _mm_movehl_ps(b_high, rg_high));
}

/// 1 / sqrt(x) within 1.5 2^-12.
inline vreal<float> estimate_inverse_sqrt(vreal<float> x)
{
    return _mm_rsqrt_ps(x);
}

inline vreal<double> widen_low(vreal<float> x)
{
    return _mm_cvtps_pd(x);
}
inline vreal<double> widen_high(vreal<float> x)
{
    return _mm_cvtps_pd(_mm_movehl_ps(x, x));
}
inline vreal<float> narrow(vreal<double> low, vreal<double> high)
{
    return _mm_movelh_ps(_mm_cvtpd_ps(low), _mm_cvtpd_ps(high));
}

constexpr CompressTable<4, 4> compress_singles;

inline vreal<float> compress(std::uint32_t pattern, vreal<float> x)
{
    const auto* order = reinterpret_cast<const __m128i*>(compress_singles.part[pattern]);
    return _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(x), _mm_load_si128(order)));
}
inline vreal<double> compress(std::uint32_t pattern, vreal<double> x)
{
    return pattern == 2 ? vreal<double>(_mm_unpackhi_pd(x, x)) : x;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
