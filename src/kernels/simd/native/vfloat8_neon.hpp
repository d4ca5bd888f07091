#pragma once

#include "kernels/simd/lanes.hpp"

#include <arm_neon.h>
#include <cstdint>

// Eight floats, whatever the packet width, for the eight boxes of a node. Here they are in two NEON
// registers.
namespace packtrace::PACKTRACE_ISA {
namespace {

struct vfloat8 {
    float32x4_t low, high;

    vfloat8() = default;
    vfloat8(float32x4_t l, float32x4_t h) : low(l), high(h)
    {
    }
    explicit vfloat8(float value) : low(vdupq_n_f32(value)), high(low)
    {
    }
};

inline vfloat8 load8(const float* from)
{
    return {vld1q_f32(from), vld1q_f32(from + 4)};
}
inline float32x4_t four_of(const double* from)
{
    return vcombine_f32(vcvt_f32_f64(vld1q_f64(from)), vcvt_f32_f64(vld1q_f64(from + 2)));
}
inline vfloat8 load8(const double* from)
{
    return {four_of(from), four_of(from + 4)};
}
inline void store8(float* to, vfloat8 a)
{
    vst1q_f32(to, a.low);
    vst1q_f32(to + 4, a.high);
}
inline vfloat8 operator+(vfloat8 a, vfloat8 b)
{
    return {vaddq_f32(a.low, b.low), vaddq_f32(a.high, b.high)};
}
inline vfloat8 operator-(vfloat8 a, vfloat8 b)
{
    return {vsubq_f32(a.low, b.low), vsubq_f32(a.high, b.high)};
}
inline vfloat8 operator*(vfloat8 a, vfloat8 b)
{
    return {vmulq_f32(a.low, b.low), vmulq_f32(a.high, b.high)};
}
inline vfloat8 operator/(vfloat8 a, vfloat8 b)
{
    return {vdivq_f32(a.low, b.low), vdivq_f32(a.high, b.high)};
}
/// a b - c, fused or not: only for bounds that are wide enough for either.
inline vfloat8 about_msub(vfloat8 a, vfloat8 b, vfloat8 c)
{
    return a * b - c;
}
inline vfloat8 sqrt(vfloat8 a)
{
    return {vsqrtq_f32(a.low), vsqrtq_f32(a.high)};
}
/// b where either is NaN.
inline vfloat8 min(vfloat8 a, vfloat8 b)
{
    return {vbslq_f32(vcltq_f32(a.low, b.low), a.low, b.low),
            vbslq_f32(vcltq_f32(a.high, b.high), a.high, b.high)};
}
/// b where either is NaN.
inline vfloat8 max(vfloat8 a, vfloat8 b)
{
    return {vbslq_f32(vcgtq_f32(a.low, b.low), a.low, b.low),
            vbslq_f32(vcgtq_f32(a.high, b.high), a.high, b.high)};
}
inline uint32x4_t sign_mask(float32x4_t a)
{
    return vreinterpretq_u32_s32(vshrq_n_s32(vreinterpretq_s32_f32(a), 31));
}
/// b where the sign bit of `sign` is set, else a.
inline vfloat8 blend(vfloat8 sign, vfloat8 a, vfloat8 b)
{
    return {vbslq_f32(sign_mask(sign.low), b.low, a.low),
            vbslq_f32(sign_mask(sign.high), b.high, a.high)};
}
/// Sign bits set where a <= b.
inline vfloat8 operator<=(vfloat8 a, vfloat8 b)
{
    return {vreinterpretq_f32_u32(vcleq_f32(a.low, b.low)),
            vreinterpretq_f32_u32(vcleq_f32(a.high, b.high))};
}
inline std::uint32_t less_equal8(vfloat8 a, vfloat8 b)
{
    const uint32x4_t lane_bit = {1, 2, 4, 8};
    const std::uint32_t low = vaddvq_u32(vandq_u32(vcleq_f32(a.low, b.low), lane_bit));
    const std::uint32_t high = vaddvq_u32(vandq_u32(vcleq_f32(a.high, b.high), lane_bit));
    return low | high << 4;
}

/// The largest element; none is NaN.
inline float largest_of8(vfloat8 a)
{
    return vmaxvq_f32(vmaxq_f32(a.low, a.high));
}

/// Element i is the reduction of the elements of v[i] by `op`, such as their minimum.
template <class Op>
inline vfloat8 reduce8(const vfloat8 (&v)[8], Op op)
{
    const auto quad = [&](float32x4_t a, float32x4_t b, float32x4_t c, float32x4_t d) {
        const vfloat8 ab = op(vfloat8(vzip1q_f32(a, b), vzip1q_f32(c, d)),
                              vfloat8(vzip2q_f32(a, b), vzip2q_f32(c, d)));
        const float32x4_t first = vcombine_f32(vget_low_f32(ab.low), vget_low_f32(ab.high));
        const float32x4_t second = vcombine_f32(vget_high_f32(ab.low), vget_high_f32(ab.high));
        return op(vfloat8(first, first), vfloat8(second, second)).low;
    };
    // Reduces the two halves of each v[i] first, then across the four elements left.
    float32x4_t half[8];
    for (int i = 0; i < 8; ++i)
        half[i] = op(vfloat8(v[i].low, v[i].low), vfloat8(v[i].high, v[i].high)).low;
    return {quad(half[0], half[1], half[2], half[3]), quad(half[4], half[5], half[6], half[7])};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
