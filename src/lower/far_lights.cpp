#include "lower/far_lights.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// How far a point is from a sphere's surface.
template <class Sphere>
double height_over(const Sphere& sphere, const Vec3& point)
{
    return std::abs(glm::length(point - sphere.center) - sphere.radius);
}

/// Spheres that a light is not well outside of, say one that is the ground.
struct LargeSpheres {
    double least = infinite;  ///< the smallest one's radius
    double off = infinite;    ///< how far the light is from their surfaces
    double reach = 0.0;       ///< and at most from a point of one that it may shine on

    /// False where the sphere is a body as others are.
    template <class Sphere>
    bool add(const Sphere& sphere, const Vec3& light)
    {
        const double height = height_over(sphere, light);
        if (height > well_outside * sphere.radius)
            return false;
        const double distance = glm::length(light - sphere.center);
        const double way = distance < sphere.radius
                               ? distance + sphere.radius
                               : std::sqrt(height * (distance + sphere.radius));
        least = std::min(least, sphere.radius);
        off = std::min(off, height);
        reach = std::max(reach, way);
        return true;
    }

    /// Whether rays from any of these points pass the light, and what is as near to it as they are,
    /// where they should.
    [[nodiscard]] bool are_met_well() const
    {
        return std::min(least, off) > well_off * reach;
    }
};

/// How far a point is from what has no bounds, at least.
double distance_to(const LoweredPlane& plane, const Vec3& point)
{
    return std::abs(glm::dot(plane.normal, point - plane.point));
}
/// On a way δ a quadric's F changes by |∇F| |δ| + bend |δ|² at most, where bend is the sum of its
/// squares' sizes: the way to F = 0 is no shorter than the root of that.
double distance_to_side(const LoweredQuadric& quadric, const Vec3& point)
{
    const Vec3 p = quadric.inverse * (point - quadric.center);
    const Vec3 half_slope = quadric.square * p + Vec3(0.0, 0.0, quadric.linear);
    const double value =
        std::abs(glm::dot(half_slope + Vec3(0.0, 0.0, quadric.linear), p) + quadric.constant);
    const double slope = 2.0 * glm::length(half_slope * quadric.inverse);
    double bend = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        bend += std::abs(quadric.square[axis]) *
                glm::dot(glm::row(quadric.inverse, axis), glm::row(quadric.inverse, axis));
    const double steepest = slope + std::sqrt(slope * slope + 4.0 * bend * value);
    return steepest > 0.0 ? 2.0 * value / steepest : 0.0;
}
double distance_to(const LoweredQuadric& quadric, const Vec3& point)
{
    double distance = distance_to_side(quadric, point);
    if (quadric.capped) {
        const double height = glm::dot(quadric.clip, point - quadric.clip_base);
        const double size = glm::length(quadric.clip);
        for (const double cap : {quadric.clip_low, quadric.clip_high})
            distance = std::min(distance, std::abs(height - cap) / size);
    }
    return distance;
}
template <class Surface>
double distance_to(const Surface&, const Vec3&)
{
    return infinite;
}

/// What a light may be far from.
class Surroundings {
public:
    explicit Surroundings(const Vec3& light) : light_(light)
    {
    }

    void add(const LoweredSphere& sphere)
    {
        if (spheres_.add(sphere, light_))
            any_large_ = true;
        else
            bodies_.add(box_of(sphere));
    }
    void add(const LoweredAnchoredSphere& sphere)
    {
        spheres_.add(sphere, light_);
        off_ = std::min(off_, height_over(sphere, light_));
    }
    template <class Surface>
    void add(const Surface& surface)
    {
        if constexpr (requires { box_of(surface); })
            if (is_bounded(surface))
                return bodies_.add(box_of(surface));
        endless_ = true;
        off_ = std::min(off_, distance_to(surface, light_));
    }

    [[nodiscard]] bool are_far() const
    {
        if (bodies_.least == infinite)
            return false;
        // Of a surface without bounds there are points that are too far off for large spheres.
        if (any_large_ && (endless_ || !spheres_.are_met_well()))
            return false;
        const double radius = 0.5 * glm::length(bodies_.high - bodies_.low);
        const double distance = glm::length(light_ - 0.5 * (bodies_.low + bodies_.high));
        return distance > largest_distance * bodies_.least && distance > well_outside * radius &&
               off_ > well_off * distance;
    }

private:
    Vec3 light_;
    Bodies bodies_;
    LargeSpheres spheres_;
    bool any_large_ = false;  ///< beside anchored ones
    bool endless_ = false;    ///< something has no bounds
    double off_ = infinite;   ///< the light from what is no body
};

}  // namespace

bool is_far(const Vec3& light, const LoweredScene& lowered)
{
    Surroundings surroundings(light);
    for_each_surface(lowered, [&](const auto& surface) { surroundings.add(surface); });
    return surroundings.are_far();
}

}  // namespace packtrace
