#pragma once

#include "kernels/simd/lanes.hpp"

#include <cstdint>
#include <immintrin.h>

// Eight floats, whatever the packet width, for the eight boxes of a node. Here they are in one AVX
// register.
namespace packtrace::PACKTRACE_ISA {
namespace {

struct vfloat8 {
    __m256 v;

    vfloat8() = default;
    vfloat8(__m256 value) : v(value)
    {
    }
    explicit vfloat8(float value) : v(_mm256_set1_ps(value))
    {
    }
};

inline vfloat8 load8(const float* from)
{
    return _mm256_loadu_ps(from);
}
inline vfloat8 load8(const double* from)
{
    return _mm256_set_m128(_mm256_cvtpd_ps(_mm256_loadu_pd(from + 4)),
                           _mm256_cvtpd_ps(_mm256_loadu_pd(from)));
}
inline void store8(float* to, vfloat8 a)
{
    _mm256_storeu_ps(to, a.v);
}
inline vfloat8 operator+(vfloat8 a, vfloat8 b)
{
    return _mm256_add_ps(a.v, b.v);
}
inline vfloat8 operator-(vfloat8 a, vfloat8 b)
{
    return _mm256_sub_ps(a.v, b.v);
}
inline vfloat8 operator*(vfloat8 a, vfloat8 b)
{
    return _mm256_mul_ps(a.v, b.v);
}
inline vfloat8 operator/(vfloat8 a, vfloat8 b)
{
    return _mm256_div_ps(a.v, b.v);
}
/// a b - c, fused or not: only for bounds that are wide enough for either.
inline vfloat8 about_msub(vfloat8 a, vfloat8 b, vfloat8 c)
{
    return _mm256_fmsub_ps(a.v, b.v, c.v);
}
inline vfloat8 sqrt(vfloat8 a)
{
    return _mm256_sqrt_ps(a.v);
}
/// b where either is NaN.
inline vfloat8 min(vfloat8 a, vfloat8 b)
{
    return _mm256_min_ps(a.v, b.v);
}
/// b where either is NaN.
inline vfloat8 max(vfloat8 a, vfloat8 b)
{
    return _mm256_max_ps(a.v, b.v);
}
/// b where the sign bit of `sign` is set, else a.
inline vfloat8 blend(vfloat8 sign, vfloat8 a, vfloat8 b)
{
    return _mm256_blendv_ps(a.v, b.v, sign.v);
}
/// Sign bits set where a <= b.
inline vfloat8 operator<=(vfloat8 a, vfloat8 b)
{
    return _mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ);
}
inline std::uint32_t less_equal8(vfloat8 a, vfloat8 b)
{
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}

/// The largest element; none is NaN.
inline float largest_of8(vfloat8 a)
{
    __m128 most = _mm_max_ps(_mm256_castps256_ps128(a.v), _mm256_extractf128_ps(a.v, 1));
    most = _mm_max_ps(most, _mm_movehl_ps(most, most));
    return _mm_cvtss_f32(_mm_max_ss(most, _mm_movehdup_ps(most)));
}

/// Element i is the reduction of the elements of v[i] by `op`, such as their minimum.
template <class Op>
inline vfloat8 reduce8(const vfloat8 (&v)[8], Op op)
{
    const auto pair = [&](vfloat8 a, vfloat8 b) {
        return op(vfloat8(_mm256_unpacklo_ps(a.v, b.v)), vfloat8(_mm256_unpackhi_ps(a.v, b.v)));
    };
    const auto quad = [&](vfloat8 a, vfloat8 b) {
        return op(vfloat8(_mm256_shuffle_ps(a.v, b.v, 0x44)),
                  vfloat8(_mm256_shuffle_ps(a.v, b.v, 0xee)));
    };
    const vfloat8 low = quad(pair(v[0], v[1]), pair(v[2], v[3]));
    const vfloat8 high = quad(pair(v[4], v[5]), pair(v[6], v[7]));
    return op(vfloat8(_mm256_permute2f128_ps(low.v, high.v, 0x20)),
              vfloat8(_mm256_permute2f128_ps(low.v, high.v, 0x31)));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
