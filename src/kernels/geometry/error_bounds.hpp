#pragma once

#include "kernels/geometry/packet.hpp"

// Bounds of the rounding errors of tests in single precision, which hold for all rays of a set: the
// origins of the set lie in a ball, which bounds every length in a test.
// docs/numerics_derivations.md derives the constants, which are in the file of each kind of
// surface.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Half a unit in the last place of 1.
inline constexpr float roundoff = 0x1p-24f;
/// Compensates for rounding errors in the computation of the bounds themselves.
inline constexpr float inflation = 1.0001f;
#if defined(__FMA__) || defined(__aarch64__)
inline constexpr float product_roundings = 1.0f;
#else
/// Without fused operations each product in a dot or cross product is rounded once more.
inline constexpr float product_roundings = 2.0f;
#endif
/// The relative error of `count` roundings.
inline constexpr float roundoffs(float count)
{
    return count * product_roundings * roundoff * inflation;
}

// Scalar versions of packet functions, for templates that take either.

/// a b + c, rounded once where the processor fuses (product_roundings).
inline float madd(float a, float b, float c)
{
#if defined(__FMA__) || defined(__aarch64__)
    return __builtin_fmaf(a, b, c);
#else
    return a * b + c;
#endif
}
inline float min(float a, float b)
{
    return b < a ? b : a;
}
inline float max(float a, float b)
{
    return b > a ? b : a;
}
inline float signed_square(float x)
{
    return x * (x < 0 ? -x : x);
}

/// Whether the rays of a set share their origin.
enum class Origin { shared, any };

/// A ball that contains the origins of a set of rays.
struct Origins {
    float center[3] = {};
    float radius = 0;  ///< 0: all origins are exactly the centre
};

/// Beyond these magnitudes squares in single precision overflow or lose digits to underflow, and no
/// error bound holds.
inline constexpr float largest_certain = 1e9f;
inline constexpr float largest_direction2 = 1e18f;
inline constexpr float smallest_direction2 = 1e-18f;

/// Lanes whose directions have magnitudes that the bounds hold for.
inline vmask<float> certifiable(const RayPacket<float>& rays)
{
    return (rays.dir2 <= vreal<float>(largest_direction2)) &
           (rays.dir2 >= vreal<float>(smallest_direction2));
}

/// Whether the bounds hold for these origins. False for NaN.
inline bool certifiable(const Origins& origins)
{
    bool within = origins.radius <= largest_certain;
    for (const float x : origins.center)
        within = within && x <= largest_certain && x >= -largest_certain;
    return within;
}

/// Origins that are all at one point.
inline Origins origins_at(const float (&point)[3])
{
    return {{point[0], point[1], point[2]}};
}

/// The ball around a box of origins, enlarged to contain origins moved by origin_offset().
inline Origins origins_in(const float (&low)[3], const float (&high)[3])
{
    Origins origins;
    float radius2 = 0;
    float size = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float half = 0.5f * (high[axis] - low[axis]);
        origins.center[axis] = low[axis] + half;
        radius2 += half * half;
        const float magnitude = origins.center[axis];
        size += (magnitude < 0 ? -magnitude : magnitude) + half;
    }
    origins.radius = __builtin_sqrtf(radius2) * inflation + roundoffs(16.0f) * size;
    return origins;
}

/// 1 / sqrt(x) within 8 roundoffs: the processor's estimate, improved by one Newton step. The
/// estimate differs between processors, but a decision by error bounds does not depend on how they
/// were rounded.
inline vreal<float> rough_inverse_sqrt(const vreal<float>& x)
{
    const vreal<float> y = estimate_inverse_sqrt(x);
    const vreal<float> half = vreal<float>(0.5f) * x * y;
    return y * nmadd(half, y, vreal<float>(1.5f));
}

/// The values of a ray that all error bounds use.
struct RayScale {
    vreal<float> inverse2;  ///< 1 / d·d, within 20 roundoffs
    vreal<float> inverse;   ///< 1 / |d|, within 10
    vreal<float> length;    ///< |d|

    explicit RayScale(const RayPacket<float>& rays) : RayScale(rays, rough_inverse_sqrt(rays.dir2))
    {
    }
    RayScale(const RayPacket<float>& rays, const vreal<float>& inverse_length)
        : inverse2(inverse_length * inverse_length),
          inverse(inverse_length),
          length(rays.dir2 * inverse_length)
    {
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
