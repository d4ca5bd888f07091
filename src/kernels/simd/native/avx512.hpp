#pragma once

#include "kernels/simd/lanes.hpp"

#include <immintrin.h>

// What xsimd lacks or gets wrong (fma of xsimd 8.1 is not fused here), in AVX-512 instructions.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline vreal<float> madd(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return _mm512_fmadd_ps(a, b, c);
}
inline vreal<double> madd(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return _mm512_fmadd_pd(a, b, c);
}
inline vreal<float> msub(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return _mm512_fmsub_ps(a, b, c);
}
inline vreal<double> msub(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return _mm512_fmsub_pd(a, b, c);
}
inline vreal<float> nmadd(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return _mm512_fnmadd_ps(a, b, c);
}
inline vreal<double> nmadd(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return _mm512_fnmadd_pd(a, b, c);
}

inline std::uint32_t bits(vmask<float> m)
{
    return static_cast<std::uint32_t>(m.data);
}
inline std::uint32_t bits(vmask<double> m)
{
    return static_cast<std::uint32_t>(m.data);
}
// xsimd 8.1 computes `|` of masks in general-purpose registers.
inline vmask<float> either(vmask<float> a, vmask<float> b)
{
    return _kor_mask16(a.data, b.data);
}
inline vmask<double> either(vmask<double> a, vmask<double> b)
{
    return _kor_mask8(a.data, b.data);
}

template <class Real>
inline vmask<Real> from_bits(std::uint32_t pattern)
{
    return vmask<Real>(static_cast<typename vmask<Real>::register_type>(pattern));
}

inline vmask<float> int_equal(vint<float> i, vint<float> j)
{
    return _mm512_cmpeq_epi32_mask(i, j);
}
inline vmask<double> int_equal(vint<double> i, vint<double> j)
{
    return _mm512_cmpeq_epi64_mask(i, j);
}
inline vmask<float> int_less(vint<float> i, vint<float> j)
{
    return _mm512_cmplt_epi32_mask(i, j);
}
inline vmask<double> int_less(vint<double> i, vint<double> j)
{
    return _mm512_cmplt_epi64_mask(i, j);
}

/// Stores r, g, b, 0 of every lane, in lane order.
inline void store_pixels(float* to, vreal<float> r, vreal<float> g, vreal<float> b)
{
    const __m512 zero = _mm512_setzero_ps();
    const __m512d rg_low = _mm512_castps_pd(_mm512_unpacklo_ps(r, g));
    const __m512d rg_high = _mm512_castps_pd(_mm512_unpackhi_ps(r, g));
    const __m512d b_low = _mm512_castps_pd(_mm512_unpacklo_ps(b, zero));
    const __m512d b_high = _mm512_castps_pd(_mm512_unpackhi_ps(b, zero));
    // Each register holds the pixels of lanes l, l + 4, l + 8 and l + 12. Then 128-bit quarters are
    // transposed.
    const __m512 first = _mm512_castpd_ps(_mm512_unpacklo_pd(rg_low, b_low));
    const __m512 second = _mm512_castpd_ps(_mm512_unpackhi_pd(rg_low, b_low));
    const __m512 third = _mm512_castpd_ps(_mm512_unpacklo_pd(rg_high, b_high));
    const __m512 fourth = _mm512_castpd_ps(_mm512_unpackhi_pd(rg_high, b_high));
    const __m512 low = _mm512_shuffle_f32x4(first, second, 0x44);
    const __m512 low_more = _mm512_shuffle_f32x4(third, fourth, 0x44);
    const __m512 high = _mm512_shuffle_f32x4(first, second, 0xee);
    const __m512 high_more = _mm512_shuffle_f32x4(third, fourth, 0xee);
    _mm512_storeu_ps(to, _mm512_shuffle_f32x4(low, low_more, 0x88));
    _mm512_storeu_ps(to + 16, _mm512_shuffle_f32x4(low, low_more, 0xdd));
    _mm512_storeu_ps(to + 32, _mm512_shuffle_f32x4(high, high_more, 0x88));
    _mm512_storeu_ps(to + 48, _mm512_shuffle_f32x4(high, high_more, 0xdd));
}

/// 1 / sqrt(x) within 2^-14.
inline vreal<float> estimate_inverse_sqrt(vreal<float> x)
{
    return _mm512_rsqrt14_ps(x);
}

inline vreal<double> widen_low(vreal<float> x)
{
    return _mm512_cvtps_pd(_mm512_castps512_ps256(x));
}
inline vreal<double> widen_high(vreal<float> x)
{
    return _mm512_cvtps_pd(_mm512_extractf32x8_ps(x, 1));
}
inline vreal<float> narrow(vreal<double> low, vreal<double> high)
{
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(low)), _mm512_cvtpd_ps(high),
                              1);
}

// The memory form of vcompressps is microcoded on Zen 4, so this compresses in the register.
inline vreal<float> compress(std::uint32_t pattern, vreal<float> x)
{
    return _mm512_maskz_compress_ps(static_cast<__mmask16>(pattern), x);
}
inline vreal<double> compress(std::uint32_t pattern, vreal<double> x)
{
    return _mm512_maskz_compress_pd(static_cast<__mmask8>(pattern), x);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
