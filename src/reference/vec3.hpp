#pragma once

#include <packtrace/vec.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace packtrace::reference {

/// A point, direction, or colour in the precision of the reference.
template <class Real>
struct Vec3 {
    Real x{};
    Real y{};
    Real z{};

    Vec3() = default;
    constexpr Vec3(Real x_, Real y_, Real z_) : x(x_), y(y_), z(z_)
    {
    }
    explicit Vec3(const packtrace::Vec3& from)
        : x(static_cast<Real>(from.x)), y(static_cast<Real>(from.y)), z(static_cast<Real>(from.z))
    {
    }

    template <class Other>
    explicit Vec3(const Vec3<Other>& from)
        : x(static_cast<Real>(from.x)), y(static_cast<Real>(from.y)), z(static_cast<Real>(from.z))
    {
    }

    Vec3& operator+=(const Vec3& b)
    {
        return *this = *this + b;
    }
    friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b)
    {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b)
    {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend constexpr Vec3 operator-(const Vec3& a)
    {
        return {-a.x, -a.y, -a.z};
    }
    /// Component by component, as colours multiply.
    friend constexpr Vec3 operator*(const Vec3& a, const Vec3& b)
    {
        return {a.x * b.x, a.y * b.y, a.z * b.z};
    }
    friend constexpr Vec3 operator*(const Vec3& a, Real s)
    {
        return {a.x * s, a.y * s, a.z * s};
    }
    friend constexpr Vec3 operator*(Real s, const Vec3& a)
    {
        return a * s;
    }
    friend constexpr Vec3 operator/(const Vec3& a, Real s)
    {
        return {a.x / s, a.y / s, a.z / s};
    }
    friend constexpr bool operator==(const Vec3& a, const Vec3& b)
    {
        return a.x == b.x && a.y == b.y && a.z == b.z;
    }
};

template <class Real>
using Color = Vec3<Real>;

/// Whether a colour or coefficient is above zero in some channel.
template <class Real>
[[nodiscard]] constexpr bool any_positive(const Color<Real>& c)
{
    return c.x > 0 || c.y > 0 || c.z > 0;
}

template <class Real>
[[nodiscard]] constexpr Real dot(const Vec3<Real>& a, const Vec3<Real>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
[[nodiscard]] constexpr Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Real>
[[nodiscard]] Real length(const Vec3<Real>& a)
{
    return std::sqrt(dot(a, a));
}

template <class Real>
[[nodiscard]] Vec3<Real> normalize(const Vec3<Real>& a)
{
    return a / length(a);
}

/// The sum of the magnitudes of a vector's components.
template <class Real>
[[nodiscard]] Real size_of(const Vec3<Real>& a)
{
    return std::abs(a.x) + std::abs(a.y) + std::abs(a.z);
}

/// As normalize(), but also right where the squares overflow or vanish. None for a vector that is
/// zero or not finite.
template <class Real>
[[nodiscard]] std::optional<Vec3<Real>> unit(const Vec3<Real>& a)
{
    using Limits = std::numeric_limits<Real>;
    const Real square = dot(a, a);
    if (square >= Limits::min() && square <= Limits::max())
        return a / std::sqrt(square);
    const Real size = size_of(a);
    if (!(size > 0 && size <= Limits::max()))
        return std::nullopt;
    return normalize(a / std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}));
}

/// The direction `V`, pointing away from the surface, mirrored about the unit normal `N`.
template <class Real>
[[nodiscard]] constexpr Vec3<Real> reflect_ray(const Vec3<Real>& V, const Vec3<Real>& N)
{
    return Real(2) * N * dot(N, V) - V;
}

}  // namespace packtrace::reference
