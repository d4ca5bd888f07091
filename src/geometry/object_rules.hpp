#pragma once

#include "kernel_abi/bvh_view.hpp"
#include <packtrace/vec.hpp>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

// Types and functions that all kinds of surfaces share.
namespace packtrace {

/// The t at which a line from inside leaves the surface; not set for a line from outside.
using Exit = std::optional<double>;

/// A box around a surface in world space. Its size is infinite for an unbounded surface.
struct CenteredBox {
    Vec3 center{0.0};
    Vec3 half{0.0};  ///< half of the sizes
};

/// The smallest positive root of a t² + 2 b t + c; infinite if there is none.
[[nodiscard]] inline double first_positive_root(double a, double b, double c)
{
    constexpr double never = std::numeric_limits<double>::infinity();
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0.0))
        return never;
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    double first = never;
    for (const double t : {q / a, c / q})
        if (t > 0.0 && t < first)
            first = t;
    return first;
}

/// Whether the error bounds of single precision hold for the magnitudes of a ball
/// (kernels/geometry/error_bounds.hpp).
[[nodiscard]] inline bool is_certifiable(const Vec3& center, double radius)
{
    constexpr double largest_certain = 1e9;
    constexpr double smallest_certain = 1e-9;
    const Vec3 size = glm::abs(center);
    return std::max({size.x, size.y, size.z}) + radius <= largest_certain &&
           radius >= smallest_certain;
}

/// Whether single precision can represent all of a box. False for a box with a NaN.
[[nodiscard]] inline bool within_tree(const CenteredBox& box)
{
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
        within = within && std::abs(box.center[axis]) + box.half[axis] <= abi::largest_coordinate;
    return within;
}

/// Whether the surface is bounded, by box_of().
template <class Kind>
[[nodiscard]] bool is_bounded(const Kind& surface)
{
    return requires
    {
        box_of(surface);
    };
}

/// Whether the surface may be in a bvh. A surface without a box stays in a list.
template <class Kind>
[[nodiscard]] bool fits_tree(const Kind& surface)
{
    if constexpr (requires { box_of(surface); })
        return within_tree(box_of(surface));
    else
        return false;
}

/// The number of surface numbers that a surface takes.
template <class Kind>
[[nodiscard]] int pieces_of(const Kind&)
{
    return 1;
}

[[nodiscard]] inline auto key_of(const Vec3& v)
{
    return std::tuple(v.x, v.y, v.z);
}

template <class Real>
void round_to(Real (&to)[3], const Vec3& from)
{
    for (int axis = 0; axis < 3; ++axis)
        to[axis] = static_cast<Real>(from[axis]);
}

template <class Real>
[[nodiscard]] Vec3 widen(const Real (&from)[3])
{
    return {from[0], from[1], from[2]};
}

}  // namespace packtrace
