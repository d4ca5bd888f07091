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

// docs/numerics_derivations.md derives these numbers.

/// A direction in single precision is off by 2^-24 of its length in each coordinate. A light more
/// than this many sizes of a body away misses it by too much.
constexpr double largest_distance = 0x1p14;

/// A light is well outside a ball if it is this many radii away.
constexpr double well_outside = 4.0;

/// A light is well off an unbounded surface if its distance from it is more than this share of its
/// distance from the bodies.
constexpr double well_off = 0x1p-10;

/// The bounded bodies.
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

/// The distance of a point from a sphere's surface.
template <class Sphere>
double height_over(const Sphere& sphere, const Vec3& point)
{
    return std::abs(glm::length(point - sphere.center) - sphere.radius);
}

/// Spheres that the light is not well outside of, such as a ground sphere.
struct LargeSpheres {
    double least = infinite;  ///< the smallest radius
    double off = infinite;    ///< the distance of the light from their surfaces
    double farthest = 0.0;  ///< the largest distance of the light from a point that it may shine on

    /// Adds a large sphere; false for a sphere that the light is well outside of.
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
        farthest = std::max(farthest, way);
        return true;
    }

    /// Whether rays from all such points to the light are exact enough.
    [[nodiscard]] bool are_hit_well() const
    {
        return std::min(least, off) > well_off * farthest;
    }
};

// A lower bound of the distance of a point from a surface; infinite for a bounded one.

double distance_to(const LoweredPlane& plane, const Vec3& point)
{
    return std::abs(glm::dot(plane.normal, point - plane.point));
}

/// Along a step δ a quadric's F changes by at most |∇F| |δ| + curvature |δ|², where curvature is
/// the sum of the squares' magnitudes. The distance to F = 0 is at least the root of this
/// quadratic.
double distance_to_side(const LoweredQuadric& quadric, const Vec3& point)
{
    const Vec3 p = quadric.inverse * (point - quadric.center);
    const Vec3 half_gradient = quadric.square * p + Vec3(0.0, 0.0, quadric.linear);
    const double value =
        std::abs(glm::dot(half_gradient + Vec3(0.0, 0.0, quadric.linear), p) + quadric.constant);
    const double gradient = 2.0 * glm::length(half_gradient * quadric.inverse);
    double curvature = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        curvature += std::abs(quadric.square[axis]) *
                     glm::dot(glm::row(quadric.inverse, axis), glm::row(quadric.inverse, axis));
    const double steepest = gradient + std::sqrt(gradient * gradient + 4.0 * curvature * value);
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

/// All surfaces of a scene, as seen from one light.
class Surroundings {
public:
    explicit Surroundings(const Vec3& light) : light_(light)
    {
    }

    void add(const LoweredSphere& sphere)
    {
        if (large_spheres_.add(sphere, light_))
            any_large_ = true;
        else
            bodies_.add(box_of(sphere));
    }
    void add(const LoweredAnchoredSphere& sphere)
    {
        large_spheres_.add(sphere, light_);
        off_ = std::min(off_, height_over(sphere, light_));
    }
    template <class Surface>
    void add(const Surface& surface)
    {
        if constexpr (requires { box_of(surface); })
            if (is_bounded(surface))
                return bodies_.add(box_of(surface));
        any_unbounded_ = true;
        off_ = std::min(off_, distance_to(surface, light_));
    }

    [[nodiscard]] bool are_far() const
    {
        if (bodies_.least == infinite)
            return false;
        // Some points of an unbounded surface are too far away for large spheres.
        if (any_large_ && (any_unbounded_ || !large_spheres_.are_hit_well()))
            return false;
        const double radius = 0.5 * glm::length(bodies_.high - bodies_.low);
        const double distance = glm::length(light_ - 0.5 * (bodies_.low + bodies_.high));
        return distance > largest_distance * bodies_.least && distance > well_outside * radius &&
               off_ > well_off * distance;
    }

private:
    Vec3 light_;
    Bodies bodies_;
    LargeSpheres large_spheres_;
    bool any_large_ = false;  ///< some large sphere is not anchored
    bool any_unbounded_ = false;
    double off_ = infinite;  ///< distance of the light from unbounded surfaces and anchored spheres
};

}  // namespace

bool is_far(const Vec3& light, const LoweredScene& lowered)
{
    Surroundings surroundings(light);
    for_each_surface(lowered, [&](const auto& surface) { surroundings.add(surface); });
    return surroundings.are_far();
}

}  // namespace packtrace
