#pragma once

#include "kernels/simd/lanes.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// What xsimd lacks, for packets of one lane. Multiply-add is fused as on all wider sets but sse42,
// so results have the same bits.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline vreal<float> madd(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return __builtin_fmaf(a.value, b.value, c.value);
}
inline vreal<double> madd(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return __builtin_fma(a.value, b.value, c.value);
}
inline vreal<float> msub(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return __builtin_fmaf(a.value, b.value, -c.value);
}
inline vreal<double> msub(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return __builtin_fma(a.value, b.value, -c.value);
}
inline vreal<float> nmadd(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return __builtin_fmaf(-a.value, b.value, c.value);
}
inline vreal<double> nmadd(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return __builtin_fma(-a.value, b.value, c.value);
}

inline std::uint32_t bits(vmask<float> m)
{
    return m.value ? 1u : 0u;
}
inline std::uint32_t bits(vmask<double> m)
{
    return m.value ? 1u : 0u;
}

inline vmask<float> int_equal(vint<float> i, vint<float> j)
{
    return {i.value == j.value};
}
inline vmask<double> int_equal(vint<double> i, vint<double> j)
{
    return {i.value == j.value};
}
inline vmask<float> int_less(vint<float> i, vint<float> j)
{
    return {i.value < j.value};
}
inline vmask<double> int_less(vint<double> i, vint<double> j)
{
    return {i.value < j.value};
}

template <class Real>
inline vmask<Real> from_bits(std::uint32_t pattern)
{
    return {(pattern & 1u) != 0};
}

/// Stores r, g, b, 0.
inline void store_pixels(float* to, vreal<float> r, vreal<float> g, vreal<float> b)
{
    to[0] = r.value;
    to[1] = g.value;
    to[2] = b.value;
    to[3] = 0.0f;
}

/// 1 / sqrt(x) within 1.5 2^-12.
inline vreal<float> estimate_inverse_sqrt(vreal<float> x)
{
#if defined(__x86_64__)
    return _mm_cvtss_f32(_mm_rsqrt_ss(_mm_set_ss(x.value)));
#else
    return 1.0f / __builtin_sqrtf(x.value);
#endif
}

// A packet of doubles has as many lanes as one of floats. The upper half is a copy of the lower; it
// is computed but not used.

inline vreal<double> widen_low(vreal<float> x)
{
    return double{x.value};
}
inline vreal<double> widen_high(vreal<float> x)
{
    return double{x.value};
}
inline vreal<float> narrow(vreal<double> low, vreal<double>)
{
    return static_cast<float>(low.value);
}

template <class Real>
inline batch<Real> compress(std::uint32_t, batch<Real> x)
{
    return x;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
