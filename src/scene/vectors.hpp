#pragma once

#include <packtrace/vec.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace packtrace {

/// The largest magnitude of a component.
[[nodiscard]] inline double largest_component(const Vec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace packtrace

namespace packtrace::language {

/// Whether a vector's length is 1, up to rounding to seven digits.
[[nodiscard]] inline bool is_unit(const Vec3& v)
{
    return std::abs(glm::dot(v, v) - 1.0) <= 1e-6;
}

/// Normalises `v` without overflow or underflow. (0, 0, 0) stays (0, 0, 0).
[[nodiscard]] inline Vec3 unit_vector(const Vec3& v)
{
    const double largest = largest_component(v);
    return largest == 0.0 ? v : glm::normalize(v / largest);
}

}  // namespace packtrace::language
