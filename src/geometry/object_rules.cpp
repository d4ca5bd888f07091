#include "geometry/object_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "kernel_abi/bvh_view.hpp"

namespace packtrace {
namespace {

constexpr double largest_certain = 1e9;
constexpr double smallest_certain = 1e-9;

}  // namespace

double first_positive_root(double a, double b, double c)
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

bool is_certifiable(const Vec3& center, double radius)
{
    const Vec3 size = glm::abs(center);
    return std::max({size.x, size.y, size.z}) + radius <= largest_certain &&
           radius >= smallest_certain;
}

bool within_tree(const CenteredBox& box)
{
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
        within = within && std::abs(box.center[axis]) + box.half[axis] <= abi::largest_coordinate;
    return within;
}

}  // namespace packtrace
