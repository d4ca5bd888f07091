#pragma once

#include "core/quad.hpp"
#include "reference/vec3.hpp"

// Ball arithmetic: numbers with a bound of their error (docs/numerics_derivations.md).
namespace packtrace::bounds {

/// All numbers whose distance from `mid` is at most `radius`; all numbers where `radius` is
/// infinite or NaN.
struct Ball {
    Quad mid = 0;
    double radius = 0.0;

    Ball() = default;
    explicit Ball(double x) : mid(x)
    {
    }
    explicit Ball(Quad) = delete;  // it would be rounded to double
    Ball(Quad m, double r) : mid(m), radius(r)
    {
    }
};

using BallVec = reference::Vec3<Ball>;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Radii are multiplied by this: a few roundings in double may make them too small.
inline constexpr double inflation = 1.0 + 0x1p-48;
/// Added to radii: underflow may make them too small by as much.
inline constexpr double smallest = 0x1p-1000;

[[nodiscard]] inline double size_of(Quad x)
{
    return std::abs(static_cast<double>(x)) * inflation;
}

/// A bound of one operation's rounding error: twice the unit roundoff of 113 bits.
[[nodiscard]] inline double rounding_of(Quad result)
{
    return result == 0 ? 0.0 : size_of(result) * 0x1p-112 + smallest;
}

[[nodiscard]] inline bool is_double(const Ball& x)
{
    return x.radius == 0.0 && static_cast<double>(x.mid) == x.mid;
}

[[nodiscard]] inline bool is_zero(const Ball& x)
{
    return x.mid == 0 && x.radius == 0.0;
}

[[nodiscard]] inline Ball operator+(const Ball& a, const Ball& b)
{
    if (is_zero(a) || is_zero(b))
        return is_zero(a) ? b : a;
    const Quad mid = a.mid + b.mid;
    // Knuth's two-sum gives the rounding error exactly.
    if (a.radius == 0.0 && b.radius == 0.0) {
        const Quad second = mid - a.mid;
        if ((a.mid - (mid - second)) + (b.mid - second) == 0)
            return {mid, 0.0};
    }
    return {mid, (a.radius + b.radius + rounding_of(mid)) * inflation};
}
[[nodiscard]] inline Ball operator-(const Ball& a)
{
    return {-a.mid, a.radius};
}
[[nodiscard]] inline Ball operator-(const Ball& a, const Ball& b)
{
    return a + -b;
}
[[nodiscard]] inline Ball operator*(const Ball& a, const Ball& b)
{
    const Quad mid = a.mid * b.mid;
    // 53 bits times 53 bits are at most 106: the product is exact.
    if ((is_double(a) && is_double(b)) || is_zero(a) || is_zero(b))
        return {mid, 0.0};
    double radius = rounding_of(mid);
    if (a.radius != 0.0 || b.radius != 0.0)
        radius +=
            size_of(a.mid) * b.radius + size_of(b.mid) * a.radius + a.radius * b.radius + smallest;
    return {mid, radius * inflation};
}

/// Whether all numbers of the ball are above zero. False where nothing is known.
[[nodiscard]] inline bool is_positive(const Ball& x)
{
    return x.mid > x.radius;
}
[[nodiscard]] inline bool is_negative(const Ball& x)
{
    return -x.mid > x.radius;
}
[[nodiscard]] inline bool has_sign(const Ball& x)
{
    return is_positive(x) || is_negative(x);
}

/// At most as large as every number of the ball.
[[nodiscard]] inline Quad lower_end(const Ball& x)
{
    return x.radius == 0.0 ? x.mid : x.mid - (Quad(x.radius * inflation) + 4 * rounding_of(x.mid));
}
[[nodiscard]] inline Quad upper_end(const Ball& x)
{
    return x.radius == 0.0 ? x.mid : x.mid + (Quad(x.radius * inflation) + 4 * rounding_of(x.mid));
}

/// The least magnitude of a ball's numbers, rounded down.
[[nodiscard]] inline double least_size(const Ball& x)
{
    const Quad least = magnitude(x.mid) - Quad(x.radius);
    return least > 0 ? round_down(least) / inflation : 0.0;
}
[[nodiscard]] inline double largest_size(const Ball& x)
{
    return (size_of(x.mid) + x.radius) * inflation;
}

/// Of infinite radius where `b` holds zero.
[[nodiscard]] inline Ball operator/(const Ball& a, const Ball& b)
{
    const double least = least_size(b);
    if (!(least > 0.0))
        return {0, infinity};
    if (is_zero(a))
        return a;
    const Quad mid = a.mid / b.mid;
    if (a.radius == 0.0 && is_double(b) && is_double(Ball(mid, 0.0)) && mid * b.mid == a.mid)
        return {mid, 0.0};
    // |a/b - A/B| <= (|a - A| + |A/B| |b - B|) / |b|.
    double radius = rounding_of(mid);
    if (a.radius != 0.0 || b.radius != 0.0)
        radius += (a.radius + size_of(mid) * b.radius) / least + smallest;
    return {mid, radius * inflation};
}

/// `x` holds no negative number.
[[nodiscard]] inline Ball square_root(const Ball& x)
{
    const Quad root = packtrace::square_root(x.mid);
    // |√x - root| = |x - root²| / (√x + root), whatever root is.
    const Quad square = root * root;
    if (x.radius == 0.0 && is_double(Ball(root, 0.0)) && square == x.mid)
        return x.mid > 0 ? Ball(root, 0.0) : Ball(0.0);
    const double off = x.radius + size_of(x.mid - square) + 2.0 * rounding_of(square);
    if (!(root > 0))
        return {0, infinity};
    return {root, (off / static_cast<double>(root) + smallest) * inflation};
}

[[nodiscard]] inline BallVec ball_vec(double x, double y, double z)
{
    return {Ball(x), Ball(y), Ball(z)};
}

}  // namespace packtrace::bounds
