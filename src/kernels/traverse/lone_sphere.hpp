#pragma once

#include "kernel_abi/shapes.hpp"
#include "kernels/traverse/bundle.hpp"

// One ray and one sphere in double, where bounds in single precision cannot tell whether the sphere
// is in the way: far quicker than to trace the ray again, and all that occlusion asks for.
namespace packtrace::PACKTRACE_ISA {
namespace {

enum class InTheWay { yes, no, undecided };

/// Share of what enters a discriminant, or a root, by which double may be wrong; a hundred times
/// more than its operations lose (docs/numerics_derivations.md).
inline constexpr double lone_slack = 0x1p-44;

/// Whether a root of a sphere lies between t_min and the end of a ray of a bundle. Undecided where
/// double itself is near its limits: the ray is traced again, with what that says of such rays.
[[gnu::noinline]] inline InTheWay is_in_the_way(const abi::SphereShape& sphere,
                                                const RayBundle<float>& bundle, int ray)
{
    double w[3];
    double d[3];
    for (int axis = 0; axis < 3; ++axis) {
        w[axis] = double{bundle.org[axis][ray]} - sphere.center[axis];
        d[axis] = bundle.dir[axis][ray];
    }
    const double a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const double b = w[0] * d[0] + w[1] * d[1] + w[2] * d[2];
    const double distance2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    const double m[3] = {w[1] * d[2] - w[2] * d[1], w[2] * d[0] - w[0] * d[2],
                         w[0] * d[1] - w[1] * d[0]};
    const double radius2 = sphere.radius * sphere.radius;
    const double discriminant = a * radius2 - (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    const double slack = lone_slack * a * (distance2 + radius2);
    if (discriminant < -slack)
        return InTheWay::no;
    if (!(discriminant > slack))
        return InTheWay::undecided;
    const double root = __builtin_sqrt(discriminant);
    const double middle = -b / a;
    const double half = root / a;
    const double error = slack / (root * a) + lone_slack * ((middle < 0 ? -middle : middle) + half);
    const double begin = bundle.t_min[ray];
    const double end = bundle.t[ray];
    const auto inside = [&](double t) { return t - error > begin && t + error < end; };
    const auto outside = [&](double t) { return t + error < begin || t - error > end; };
    if (inside(middle - half) || inside(middle + half))
        return InTheWay::yes;
    return outside(middle - half) && outside(middle + half) ? InTheWay::no : InTheWay::undecided;
}

/// The same of the sphere with this surface number.
inline InTheWay is_in_the_way(const abi::ShapesView& shapes, std::int32_t surface,
                              const RayBundle<float>& bundle, int ray)
{
    return is_in_the_way(shapes.spheres[shapes.index[surface].record], bundle, ray);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
