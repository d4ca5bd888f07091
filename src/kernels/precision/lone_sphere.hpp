#pragma once

#include "kernel_abi/shapes.hpp"

// Tests one ray and one sphere in double, where error bounds in single precision cannot decide.
// This is much faster than tracing the ray again among all objects.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The share of the terms of a discriminant or root by which double may be wrong. It is a hundred
/// times what the operations lose (docs/numerics_derivations.md).
inline constexpr double lone_slack = 0x1p-44;

/// An answer in double; undecided if it is too close to the limits of double.
enum class InDouble { yes, no, undecided };

/// The sphere that has this surface number.
inline const abi::SphereShape& sphere_of(const abi::ShapesView& shapes, std::int32_t surface)
{
    return shapes.spheres[shapes.index[surface].record];
}

/// Prefetches what sphere_of() reads, which in large scenes is not in the cache. The address is a
/// guess: in a scene of spheres only, the number of a record is that of its surface.
inline void fetch_sphere(const abi::ShapesView& shapes, std::int32_t surface)
{
    __builtin_prefetch(shapes.index + surface);
    __builtin_prefetch(shapes.spheres + surface);
}

/// A ray in single precision, widened to double.
struct WideRay {
    double org[3];
    double dir[3];
    double t_min;
};

/// Whether a ray hits a sphere, and both roots within `error`.
struct LoneRoots {
    InDouble crosses;
    double near, far;
    double error;
};

inline LoneRoots lone_roots(const abi::SphereShape& sphere, const WideRay& ray)
{
    double w[3];
    for (int axis = 0; axis < 3; ++axis)
        w[axis] = ray.org[axis] - sphere.center[axis];
    const double(&d)[3] = ray.dir;
    const double a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const double b = w[0] * d[0] + w[1] * d[1] + w[2] * d[2];
    const double distance2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    const double m[3] = {w[1] * d[2] - w[2] * d[1], w[2] * d[0] - w[0] * d[2],
                         w[0] * d[1] - w[1] * d[0]};
    const double radius2 = sphere.radius * sphere.radius;
    const double discriminant = a * radius2 - (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    const double slack = lone_slack * a * (distance2 + radius2);
    if (discriminant < -slack)
        return {InDouble::no, 0, 0, 0};
    if (!(discriminant > slack))
        return {InDouble::undecided, 0, 0, 0};
    const double root = __builtin_sqrt(discriminant);
    const double middle = -b / a;
    const double half = root / a;
    const double error = slack / (root * a) + lone_slack * ((middle < 0 ? -middle : middle) + half);
    return {InDouble::yes, middle - half, middle + half, error};
}

/// Whether the sphere has a hit between the ray's t_min and `t_end`.
[[gnu::noinline]] inline InDouble is_in_the_way(const abi::SphereShape& sphere, const WideRay& ray,
                                                double t_end)
{
    const LoneRoots at = lone_roots(sphere, ray);
    if (at.crosses != InDouble::yes)
        return at.crosses;
    const auto inside = [&](double t) { return t - at.error > ray.t_min && t + at.error < t_end; };
    const auto outside = [&](double t) { return t + at.error < ray.t_min || t - at.error > t_end; };
    if (inside(at.near) || inside(at.far))
        return InDouble::yes;
    return outside(at.near) && outside(at.far) ? InDouble::no : InDouble::undecided;
}

/// Whether a ray hits a sphere beyond its t_min, and the interval of the first hit in single
/// precision.
struct FirstHit {
    InDouble there;
    float low, high;
};

/// Smaller roots are left undecided: intervals of a few roundoffs around them underflow in single
/// precision.
inline constexpr double least_root = 1e-30;

[[gnu::noinline]] inline FirstHit first_hit(const abi::SphereShape& sphere, const WideRay& ray)
{
    const LoneRoots at = lone_roots(sphere, ray);
    if (at.crosses != InDouble::yes)
        return {at.crosses, 0, 0};
    if (at.far + at.error < ray.t_min)
        return {InDouble::no, 0, 0};
    const double t = at.near + at.error < ray.t_min ? at.far : at.near;
    if (!(t - at.error > ray.t_min) || !(t > least_root))
        return {InDouble::undecided, 0, 0};
    // The interval is widened by more than rounding to single precision narrows it.
    return {InDouble::yes, static_cast<float>((t - at.error) * (1.0 - 0x1p-22)),
            static_cast<float>((t + at.error) * (1.0 + 0x1p-22))};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
