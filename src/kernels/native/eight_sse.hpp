#pragma once

#include <immintrin.h>

#include <cstdint>

#include "kernels/isa.hpp"

// Eight floats, whatever the packet width: the boxes of a node. Here in two SSE registers.
namespace packtrace::PACKTRACE_ISA {
namespace {

struct Eight {
    __m128 low, high;

    Eight() = default;
    Eight(__m128 l, __m128 h) : low(l), high(h)
    {
    }
    explicit Eight(float value) : low(_mm_set1_ps(value)), high(low)
    {
    }
};

inline Eight load8(const float* from)
{
    return {_mm_loadu_ps(from), _mm_loadu_ps(from + 4)};
}
inline __m128 four_of(const double* from)
{
    return _mm_movelh_ps(_mm_cvtpd_ps(_mm_loadu_pd(from)), _mm_cvtpd_ps(_mm_loadu_pd(from + 2)));
}
inline Eight load8(const double* from)
{
    return {four_of(from), four_of(from + 4)};
}
inline void store8(float* to, Eight a)
{
    _mm_storeu_ps(to, a.low);
    _mm_storeu_ps(to + 4, a.high);
}
inline Eight operator+(Eight a, Eight b)
{
    return {_mm_add_ps(a.low, b.low), _mm_add_ps(a.high, b.high)};
}
inline Eight operator-(Eight a, Eight b)
{
    return {_mm_sub_ps(a.low, b.low), _mm_sub_ps(a.high, b.high)};
}
inline Eight operator*(Eight a, Eight b)
{
    return {_mm_mul_ps(a.low, b.low), _mm_mul_ps(a.high, b.high)};
}
inline Eight operator/(Eight a, Eight b)
{
    return {_mm_div_ps(a.low, b.low), _mm_div_ps(a.high, b.high)};
}
/// a b - c, fused or not: only for bounds with room for either.
inline Eight about_msub(Eight a, Eight b, Eight c)
{
    return a * b - c;
}
inline Eight sqrt8(Eight a)
{
    return {_mm_sqrt_ps(a.low), _mm_sqrt_ps(a.high)};
}
/// b where either is NaN.
inline Eight min8(Eight a, Eight b)
{
    return {_mm_min_ps(a.low, b.low), _mm_min_ps(a.high, b.high)};
}
/// b where either is NaN.
inline Eight max8(Eight a, Eight b)
{
    return {_mm_max_ps(a.low, b.low), _mm_max_ps(a.high, b.high)};
}
/// b where the sign bit of `sign` is set, else a.
inline Eight by_sign(Eight sign, Eight a, Eight b)
{
    return {_mm_blendv_ps(a.low, b.low, sign.low), _mm_blendv_ps(a.high, b.high, sign.high)};
}
/// Sign bits set where a <= b.
inline Eight at_most8(Eight a, Eight b)
{
    return {_mm_cmple_ps(a.low, b.low), _mm_cmple_ps(a.high, b.high)};
}
inline std::uint32_t less_equal8(Eight a, Eight b)
{
    const int low = _mm_movemask_ps(_mm_cmple_ps(a.low, b.low));
    const int high = _mm_movemask_ps(_mm_cmple_ps(a.high, b.high));
    return static_cast<std::uint32_t>(low | high << 4);
}

/// The largest element; none is NaN.
inline float largest_of8(Eight a)
{
    __m128 most = _mm_max_ps(a.low, a.high);
    most = _mm_max_ps(most, _mm_movehl_ps(most, most));
    return _mm_cvtss_f32(_mm_max_ss(most, _mm_movehdup_ps(most)));
}

/// Element i is what `op` makes of v[i]'s elements, such as the least of them.
template <class Op>
inline Eight reduce8(const Eight (&v)[8], Op op)
{
    const auto quad = [&](__m128 a, __m128 b, __m128 c, __m128 d) {
        _MM_TRANSPOSE4_PS(a, b, c, d);
        const Eight half = op(Eight(a, c), Eight(b, d));
        return op(Eight(half.low, half.low), Eight(half.high, half.high)).low;
    };
    // Both halves of each first, then across them.
    __m128 half[8];
    for (int i = 0; i < 8; ++i)
        half[i] = op(Eight(v[i].low, v[i].low), Eight(v[i].high, v[i].high)).low;
    return {quad(half[0], half[1], half[2], half[3]), quad(half[4], half[5], half[6], half[7])};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
