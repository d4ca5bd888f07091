#pragma once

#include "kernels/simd/lanes.hpp"

#include <arm_neon.h>

// For floats, xsimd 8 uses what 32-bit Arm has: quotients and square roots from estimates, and
// rounding through integers, which loses the sign of zero. 64-bit Arm has correctly rounded
// instructions for all of these.
namespace xsimd {

template <>
inline __attribute__((always_inline)) batch<float, neon64>& batch<float, neon64>::operator/=(
    const batch<float, neon64>& divisor) noexcept
{
    return *this = vdivq_f32(*this, divisor);
}
template <>
inline __attribute__((always_inline)) batch<float, neon64> sqrt(
    const batch<float, neon64>& x) noexcept
{
    return vsqrtq_f32(x);
}
template <>
inline __attribute__((always_inline)) batch<float, neon64> floor(
    const batch<float, neon64>& x) noexcept
{
    return vrndmq_f32(x);
}
template <>
inline __attribute__((always_inline)) batch<double, neon64> floor(
    const batch<double, neon64>& x) noexcept
{
    return vrndmq_f64(x);
}

}  // namespace xsimd

// What xsimd lacks, or names differently between versions, in 64-bit Arm instructions.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline vreal<float> madd(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return vfmaq_f32(c, a, b);
}
inline vreal<double> madd(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return vfmaq_f64(c, a, b);
}
inline vreal<float> msub(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return vfmaq_f32(vnegq_f32(c), a, b);
}
inline vreal<double> msub(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return vfmaq_f64(vnegq_f64(c), a, b);
}
inline vreal<float> nmadd(vreal<float> a, vreal<float> b, vreal<float> c)
{
    return vfmsq_f32(c, a, b);
}
inline vreal<double> nmadd(vreal<double> a, vreal<double> b, vreal<double> c)
{
    return vfmsq_f64(c, a, b);
}

inline std::uint32_t bits(vmask<float> m)
{
    const std::uint32_t lane_bit[4] = {1, 2, 4, 8};
    return vaddvq_u32(vandq_u32(m, vld1q_u32(lane_bit)));
}
inline std::uint32_t bits(vmask<double> m)
{
    const std::uint64_t lane_bit[2] = {1, 2};
    return static_cast<std::uint32_t>(vaddvq_u64(vandq_u64(m, vld1q_u64(lane_bit))));
}

inline vmask<float> int_equal(vint<float> i, vint<float> j)
{
    return vceqq_s32(i, j);
}
inline vmask<double> int_equal(vint<double> i, vint<double> j)
{
    return vceqq_s64(i, j);
}
inline vmask<float> int_less(vint<float> i, vint<float> j)
{
    return vcltq_s32(i, j);
}
inline vmask<double> int_less(vint<double> i, vint<double> j)
{
    return vcltq_s64(i, j);
}

template <class Real>
vmask<Real> from_bits(std::uint32_t pattern);
template <>
inline vmask<float> from_bits<float>(std::uint32_t pattern)
{
    const std::uint32_t lane_bit[4] = {1, 2, 4, 8};
    return vtstq_u32(vdupq_n_u32(pattern), vld1q_u32(lane_bit));
}
template <>
inline vmask<double> from_bits<double>(std::uint32_t pattern)
{
    const std::uint64_t lane_bit[2] = {1, 2};
    return vtstq_u64(vdupq_n_u64(pattern), vld1q_u64(lane_bit));
}

/// Stores r, g, b, 0 of every lane, in lane order.
inline void store_pixels(float* to, vreal<float> r, vreal<float> g, vreal<float> b)
{
    vst4q_f32(to, (float32x4x4_t{{r, g, b, vdupq_n_f32(0.0f)}}));
}

/// 1 / sqrt(x) within 2^-14.
inline vreal<float> estimate_inverse_sqrt(vreal<float> x)
{
    const float32x4_t rough = vrsqrteq_f32(x);
    return vmulq_f32(rough, vrsqrtsq_f32(vmulq_f32(x, rough), rough));
}

inline vreal<double> widen_low(vreal<float> x)
{
    return vcvt_f64_f32(vget_low_f32(x));
}
inline vreal<double> widen_high(vreal<float> x)
{
    return vcvt_high_f64_f32(x);
}
inline vreal<float> narrow(vreal<double> low, vreal<double> high)
{
    return vcvt_high_f32_f64(vcvt_f32_f64(low), high);
}

template <class Real>
inline xsimd::batch<Real, Arch> compress(std::uint32_t pattern, xsimd::batch<Real, Arch> x)
{
    alignas(16) Real in[lanes<Real>];
    alignas(16) Real out[lanes<Real>] = {};
    x.store_aligned(in);
    int next = 0;
    for (int lane = 0; lane < lanes<Real>; ++lane)
        if ((pattern >> lane) & 1u)
            out[next++] = in[lane];
    return xsimd::batch<Real, Arch>::load_aligned(out);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
