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

// What every kind of surface answers with, and what they share in finding and packing it.
namespace packtrace {

/// Where a line from inside leaves again, as a t; nothing from outside.
using Exit = std::optional<double>;

/// A box around a surface in world space, of infinite size around one without bounds.
struct CenteredBox {
    Vec3 center{0.0};
    Vec3 half{0.0};  ///< of its sizes
};

/// The first root above 0 of a t² + 2 b t + c; infinite where there is none.
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

/// Whether error bounds in single precision hold for the magnitudes of a ball
/// (kernels/geometry/error_bounds.hpp).
[[nodiscard]] inline bool is_certifiable(const Vec3& center, double radius)
{
    constexpr double largest_certain = 1e9;
    constexpr double smallest_certain = 1e-9;
    const Vec3 size = glm::abs(center);
    return std::max({size.x, size.y, size.z}) + radius <= largest_certain &&
           radius >= smallest_certain;
}

/// Whether single precision reckons with all of a box; not with one at NaN.
[[nodiscard]] inline bool within_tree(const CenteredBox& box)
{
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
        within = within && std::abs(box.center[axis]) + box.half[axis] <= abi::largest_coordinate;
    return within;
}

/// Whether the surface ends on all sides, within box_of().
template <class Kind>
[[nodiscard]] bool is_bounded(const Kind& surface)
{
    return requires { box_of(surface); };
}

/// Whether a tree may hold the surface; one without a box stays in a list.
template <class Kind>
[[nodiscard]] bool fits_tree(const Kind& surface)
{
    if constexpr (requires { box_of(surface); })
        return within_tree(box_of(surface));
    else
        return false;
}

/// How many surface numbers a surface takes.
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
