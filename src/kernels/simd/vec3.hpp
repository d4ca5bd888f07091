#pragma once

#include "kernels/simd/simd.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// One vector per lane. Copies are written member by member, because GCC 12 copies a trivial
/// aggregate of this size through the stack in 16-byte pieces, and loading whole registers from
/// there stalls.
template <class Real>
struct Vec3v {
    vreal<Real> x, y, z;

    Vec3v() = default;
    Vec3v(const vreal<Real>& x_, const vreal<Real>& y_, const vreal<Real>& z_) : x(x_), y(y_), z(z_)
    {
    }
    Vec3v(const Vec3v& other) : x(other.x), y(other.y), z(other.z)
    {
    }
    Vec3v& operator=(const Vec3v& other)
    {
        x = other.x;
        y = other.y;
        z = other.z;
        return *this;
    }
};

/// The same vector in every lane.
template <class Real>
inline Vec3v<Real> broadcast(const Real (&v)[3])
{
    return {vreal<Real>(v[0]), vreal<Real>(v[1]), vreal<Real>(v[2])};
}

template <class Real>
inline Vec3v<Real> operator+(const Vec3v<Real>& a, const Vec3v<Real>& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Real>
inline Vec3v<Real> operator-(const Vec3v<Real>& a, const Vec3v<Real>& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Real>
inline Vec3v<Real> operator*(const Vec3v<Real>& a, const Vec3v<Real>& b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

template <class Real>
inline Vec3v<Real> scale(batch<Real> s, const Vec3v<Real>& a)
{
    return {s * a.x, s * a.y, s * a.z};
}

/// s a + b
template <class Real>
inline Vec3v<Real> madd(batch<Real> s, const Vec3v<Real>& a, const Vec3v<Real>& b)
{
    return {madd(s, a.x, b.x), madd(s, a.y, b.y), madd(s, a.z, b.z)};
}

/// a b + c in each channel
template <class Real>
inline Vec3v<Real> madd(const Vec3v<Real>& a, const Vec3v<Real>& b, const Vec3v<Real>& c)
{
    return {madd(a.x, b.x, c.x), madd(a.y, b.y, c.y), madd(a.z, b.z, c.z)};
}

template <class Real>
inline vreal<Real> dot(const Vec3v<Real>& a, const Vec3v<Real>& b)
{
    return madd(a.x, b.x, madd(a.y, b.y, a.z * b.z));
}

/// The sum of |a_i| |b_i|: the scale of the rounding error of a·b.
template <class Real>
inline vreal<Real> magnitude_dot(const Vec3v<Real>& a, const Vec3v<Real>& b)
{
    return madd(abs(a.x), abs(b.x), madd(abs(a.y), abs(b.y), abs(a.z) * abs(b.z)));
}

/// |x| + |y| + |z|.
template <class Real>
inline vreal<Real> size_of(const Vec3v<Real>& v)
{
    return abs(v.x) + abs(v.y) + abs(v.z);
}

template <class Real>
inline Vec3v<Real> cross(const Vec3v<Real>& a, const Vec3v<Real>& b)
{
    return {msub(a.y, b.z, a.z * b.y), msub(a.z, b.x, a.x * b.z), msub(a.x, b.y, a.y * b.x)};
}

template <class Real>
inline Vec3v<Real> select(batch_bool<Real> active, const Vec3v<Real>& a, const Vec3v<Real>& b)
{
    return {select(active, a.x, b.x), select(active, a.y, b.y), select(active, a.z, b.z)};
}

// A packet of floats is widened to two packets of doubles, which is exact. Narrowing rounds once.

inline Vec3v<double> widen_low(const Vec3v<float>& v)
{
    return {widen_low(v.x), widen_low(v.y), widen_low(v.z)};
}
inline Vec3v<double> widen_high(const Vec3v<float>& v)
{
    return {widen_high(v.x), widen_high(v.y), widen_high(v.z)};
}

inline Vec3v<float> narrow(const Vec3v<double>& low, const Vec3v<double>& high)
{
    return {narrow(low.x, high.x), narrow(low.y, high.y), narrow(low.z, high.z)};
}

/// The bit pattern of a packet of floats, from the patterns of its low and high half.
inline std::uint32_t narrow_bits(std::uint32_t low, std::uint32_t high)
{
    return (low | (high << lanes<double>)) & all_lanes<float>;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
