#include "lower/far_lights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace packtrace {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A direction in single precision is off by 2^-24 of its length in each coordinate: beyond so many
/// sizes of a body rays from a light miss it by too much.
constexpr double largest_distance = 0x1p14;

/// So many radii of a ball around all bodies a light has to be away from them.
constexpr double well_outside = 4.0;

/// The share of its distance from the bodies by which a light has to be off what has no bounds.
constexpr double well_off = 0x1p-10;

/// The bodies that have bounds.
struct Bodies {
    Vec3 low{infinite};
    Vec3 high{-infinite};
    double least = infinite;  ///< half the longest side of the smallest

    void add(const CenteredBox& box)
    {
        low = glm::min(low, box.center - box.half);
        high = glm::max(high, box.center + box.half);
        least = std::min(least, std::max({box.half.x, box.half.y, box.half.z}));
    }
};

/// How far a point is from what has no bounds; nothing tells of quadrics.
double distance_to(const LoweredPlane& plane, const Vec3& point)
{
    return std::abs(glm::dot(plane.normal, point - plane.point));
}
double distance_to(const LoweredAnchoredSphere& sphere, const Vec3& point)
{
    return std::abs(glm::length(point - sphere.center) - sphere.radius);
}
template <class Surface>
double distance_to(const Surface&, const Vec3&)
{
    return 0.0;
}

}  // namespace

bool is_far(const Vec3& light, const LoweredScene& lowered)
{
    Bodies bodies;
    double off = infinite;
    for_each_surface(lowered, [&](const auto& surface) {
        if constexpr (requires { box_of(surface); })
            if (is_bounded(surface))
                return bodies.add(box_of(surface));
        off = std::min(off, distance_to(surface, light));
    });
    if (bodies.least == infinite)
        return false;
    const double radius = 0.5 * glm::length(bodies.high - bodies.low);
    const double distance = glm::length(light - 0.5 * (bodies.low + bodies.high));
    return distance > largest_distance * bodies.least && distance > well_outside * radius &&
           off > well_off * distance;
}

}  // namespace packtrace
