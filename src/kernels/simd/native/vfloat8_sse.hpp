#pragma once

#include "kernels/simd/lanes.hpp"

#include <cstdint>
#include <immintrin.h>

// Eight floats, whatever the packet width, for the eight boxes of a node. Here they are in two SSE
// registers.
namespace packtrace::PACKTRACE_ISA {
namespace {

struct vfloat8 {
    __m128 low, high;

    vfloat8() = default;
    vfloat8(__m128 l, __m128 h) : low(l), high(h)
    {
    }
    explicit vfloat8(float value) : low(_mm_set1_ps(value)), high(low)
    {
    }
};

inline vfloat8 load8(const float* from)
{
    return {_mm_loadu_ps(from), _mm_loadu_ps(from + 4)};
}
inline __m128 four_of(const double* from)
{
    return _mm_movelh_ps(_mm_cvtpd_ps(_mm_loadu_pd(from)), _mm_cvtpd_ps(_mm_loadu_pd(from + 2)));
}
inline vfloat8 load8(const double* from)
{
    return {four_of(from), four_of(from + 4)};
}
inline void store8(float* to, vfloat8 a)
{
    _mm_storeu_ps(to, a.low);
    _mm_storeu_ps(to + 4, a.high);
}
inline vfloat8 operator+(vfloat8 a, vfloat8 b)
{
    return {_mm_add_ps(a.low, b.low), _mm_add_ps(a.high, b.high)};
}
inline vfloat8 operator-(vfloat8 a, vfloat8 b)
{
    return {_mm_sub_ps(a.low, b.low), _mm_sub_ps(a.high, b.high)};
}
inline vfloat8 operator*(vfloat8 a, vfloat8 b)
{
    return {_mm_mul_ps(a.low, b.low), _mm_mul_ps(a.high, b.high)};
}
inline vfloat8 operator/(vfloat8 a, vfloat8 b)
{
    return {_mm_div_ps(a.low, b.low), _mm_div_ps(a.high, b.high)};
}
/// a b - c, fused or not: only for bounds that are wide enough for either.
inline vfloat8 about_msub(vfloat8 a, vfloat8 b, vfloat8 c)
{
    return a * b - c;
}
inline vfloat8 sqrt(vfloat8 a)
{
    return {_mm_sqrt_ps(a.low), _mm_sqrt_ps(a.high)};
}
/// b where either is NaN.
inline vfloat8 min(vfloat8 a, vfloat8 b)
{
    return {_mm_min_ps(a.low, b.low), _mm_min_ps(a.high, b.high)};
}
/// b where either is NaN.
inline vfloat8 max(vfloat8 a, vfloat8 b)
{
    return {_mm_max_ps(a.low, b.low), _mm_max_ps(a.high, b.high)};
}
/// b where the sign bit of `sign` is set, else a.
inline vfloat8 blend(vfloat8 sign, vfloat8 a, vfloat8 b)
{
    return {_mm_blendv_ps(a.low, b.low, sign.low), _mm_blendv_ps(a.high, b.high, sign.high)};
}
/// Sign bits set where a <= b.
inline vfloat8 operator<=(vfloat8 a, vfloat8 b)
{
    return {_mm_cmple_ps(a.low, b.low), _mm_cmple_ps(a.high, b.high)};
}
inline std::uint32_t less_equal8(vfloat8 a, vfloat8 b)
{
    const int low = _mm_movemask_ps(_mm_cmple_ps(a.low, b.low));
    const int high = _mm_movemask_ps(_mm_cmple_ps(a.high, b.high));
    return static_cast<std::uint32_t>(low | high << 4);
}

/// The largest element; none is NaN.
inline float largest_of8(vfloat8 a)
{
    __m128 most = _mm_max_ps(a.low, a.high);
    most = _mm_max_ps(most, _mm_movehl_ps(most, most));
    return _mm_cvtss_f32(_mm_max_ss(most, _mm_movehdup_ps(most)));
}

/// Element i is the reduction of the elements of v[i] by `op`, such as their minimum.
template <class Op>
inline vfloat8 reduce8(const vfloat8 (&v)[8], Op op)
{
    const auto quad = [&](__m128 a, __m128 b, __m128 c, __m128 d) {
        _MM_TRANSPOSE4_PS(a, b, c, d);
        const vfloat8 half = op(vfloat8(a, c), vfloat8(b, d));
        return op(vfloat8(half.low, half.low), vfloat8(half.high, half.high)).low;
    };
    // Reduces the two halves of each v[i] first, then across the four elements left.
    __m128 half[8];
    for (int i = 0; i < 8; ++i)
        half[i] = op(vfloat8(v[i].low, v[i].low), vfloat8(v[i].high, v[i].high)).low;
    return {quad(half[0], half[1], half[2], half[3]), quad(half[4], half[5], half[6], half[7])};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
