#pragma once

#include <cstdint>

// Eight floats for the eight boxes of a node, as an array.
namespace packtrace::PACKTRACE_ISA {
namespace {

struct vfloat8 {
    float at[8];

    vfloat8() = default;
    explicit vfloat8(float value)
    {
        for (float& each : at)
            each = value;
    }
};

/// `op` of each pair of elements.
template <class Op>
inline vfloat8 each8(const vfloat8& a, const vfloat8& b, const Op& op)
{
    vfloat8 result;
    for (int i = 0; i < 8; ++i)
        result.at[i] = op(a.at[i], b.at[i]);
    return result;
}

template <class Real>
inline vfloat8 load8(const Real* from)
{
    vfloat8 result;
    for (int i = 0; i < 8; ++i)
        result.at[i] = static_cast<float>(from[i]);
    return result;
}
inline void store8(float* to, const vfloat8& a)
{
    for (int i = 0; i < 8; ++i)
        to[i] = a.at[i];
}
inline vfloat8 operator+(const vfloat8& a, const vfloat8& b)
{
    return each8(a, b, [](float x, float y) { return x + y; });
}
inline vfloat8 operator-(const vfloat8& a, const vfloat8& b)
{
    return each8(a, b, [](float x, float y) { return x - y; });
}
inline vfloat8 operator*(const vfloat8& a, const vfloat8& b)
{
    return each8(a, b, [](float x, float y) { return x * y; });
}
inline vfloat8 operator/(const vfloat8& a, const vfloat8& b)
{
    return each8(a, b, [](float x, float y) { return x / y; });
}
/// a b - c, fused or not: only for bounds that are wide enough for either.
inline vfloat8 about_msub(const vfloat8& a, const vfloat8& b, const vfloat8& c)
{
    return a * b - c;
}
inline vfloat8 sqrt(const vfloat8& a)
{
    return each8(a, a, [](float x, float) { return __builtin_sqrtf(x); });
}
/// b where either is NaN.
inline vfloat8 min(const vfloat8& a, const vfloat8& b)
{
    return each8(a, b, [](float x, float y) { return x < y ? x : y; });
}
/// b where either is NaN.
inline vfloat8 max(const vfloat8& a, const vfloat8& b)
{
    return each8(a, b, [](float x, float y) { return x > y ? x : y; });
}
/// b where the sign bit of `sign` is set, else a.
inline vfloat8 blend(const vfloat8& sign, const vfloat8& a, const vfloat8& b)
{
    vfloat8 result;
    for (int i = 0; i < 8; ++i)
        result.at[i] = __builtin_signbit(sign.at[i]) ? b.at[i] : a.at[i];
    return result;
}
/// Sign bits set where a <= b.
inline vfloat8 operator<=(const vfloat8& a, const vfloat8& b)
{
    return each8(a, b, [](float x, float y) { return x <= y ? -1.0f : 0.0f; });
}
inline std::uint32_t less_equal8(const vfloat8& a, const vfloat8& b)
{
    std::uint32_t result = 0;
    for (int i = 0; i < 8; ++i)
        result |= (a.at[i] <= b.at[i] ? 1u : 0u) << i;
    return result;
}

/// The largest element; none is NaN.
inline float largest_of8(const vfloat8& a)
{
    float most = a.at[0];
    for (const float each : a.at)
        most = each > most ? each : most;
    return most;
}

/// Element i is the reduction of the elements of v[i] by `op`, such as their minimum.
template <class Op>
inline vfloat8 reduce8(const vfloat8 (&v)[8], Op op)
{
    vfloat8 result;
    for (int i = 0; i < 8; ++i) {
        vfloat8 all = v[i];
        for (int half = 4; half > 0; half /= 2) {
            vfloat8 other;
            for (int j = 0; j < 8; ++j)
                other.at[j] = all.at[(j + half) % 8];
            all = op(all, other);
        }
        result.at[i] = all.at[0];
    }
    return result;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
