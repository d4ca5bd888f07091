#include <algorithm>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lower/lower_surface.hpp"

namespace packtrace {
namespace {

/// How many times larger than the scene a sphere must be; from the study of formulas in
/// docs/numerics.md, where both forms are about as exact at this ratio.
constexpr double huge_ratio = 50.0;

struct Extent {
    Vec3 low{std::numeric_limits<double>::infinity()};
    Vec3 high{-std::numeric_limits<double>::infinity()};

    void include(const Vec3& center, double radius)
    {
        low = glm::min(low, center - radius);
        high = glm::max(high, center + radius);
    }
    [[nodiscard]] Vec3 middle() const
    {
        return 0.5 * (low + high);
    }
    [[nodiscard]] double radius() const
    {
        return 0.5 * glm::length(high - low);
    }
};

Vec3 nearest_surface_point(const LoweredSphere& sphere, const Vec3& to)
{
    const Vec3 outwards = to - sphere.center;
    const double distance = glm::length(outwards);
    if (distance == 0.0)
        return sphere.center + Vec3(0.0, sphere.radius, 0.0);
    return sphere.center + outwards * (sphere.radius / distance);
}

bool is_huge(const LoweredSphere& sphere, const Extent& extent)
{
    const Vec3 anchor = nearest_surface_point(sphere, extent.middle());
    const double size = std::max(extent.radius(), glm::length(anchor - extent.middle()));
    return sphere.radius > huge_ratio * size;
}

}  // namespace

void mark_huge_spheres(const Vec3& eye, LoweredScene& lowered)
{
    Extent extent;
    extent.include(eye, 0.0);
    for (const Light& light : lowered.lights)
        if (light.type == LightType::point)
            extent.include(light.vector, 0.0);

    // From the smallest up: a sphere that is not huge is part of the scene that later ones
    // are held against.
    std::vector<LoweredSphere*> by_radius;
    for (LoweredSphere& sphere : lowered.spheres)
        by_radius.push_back(&sphere);
    std::stable_sort(
        by_radius.begin(), by_radius.end(),
        [](const LoweredSphere* a, const LoweredSphere* b) { return a->radius < b->radius; });
    for (LoweredSphere* sphere : by_radius) {
        sphere->huge = is_huge(*sphere, extent);
        if (!sphere->huge)
            extent.include(sphere->center, sphere->radius);
    }
    for (LoweredSphere& sphere : lowered.spheres)
        if (sphere.huge)
            sphere.anchor = nearest_surface_point(sphere, extent.middle());
}

}  // namespace packtrace
