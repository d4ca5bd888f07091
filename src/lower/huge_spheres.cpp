#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include <tbb/parallel_sort.h>
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
    // Most spheres are not by far, which costs no look at their places.
    if (!(sphere.radius > huge_ratio * extent.radius()))
        return false;
    const Vec3 anchor = nearest_surface_point(sphere, extent.middle());
    return sphere.radius > huge_ratio * glm::length(anchor - extent.middle());
}

/// From the smallest up, equal ones as they are numbered.
std::vector<std::uint32_t> order_by_radius(const std::vector<LoweredSphere>& spheres)
{
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const double left = spheres[a].radius;
        const double right = spheres[b].radius;
        return left < right || (left == right && a < b);
    };
    std::vector<std::uint32_t> order(spheres.size());
    std::iota(order.begin(), order.end(), 0u);
    if (!std::is_sorted(order.begin(), order.end(), before))
        tbb::parallel_sort(order.begin(), order.end(), before);
    return order;
}

/// Moves the spheres numbered by `huge` in `lowered.spheres`, rising.
void move_huge(const std::vector<std::uint32_t>& huge, const Vec3& middle, LoweredScene& lowered)
{
    for (const std::uint32_t number : huge) {
        LoweredSphere& sphere = lowered.spheres[number];
        lowered.huge_spheres.push_back(
            {sphere.center, sphere.radius, nearest_surface_point(sphere, middle), sphere.surface});
        sphere.surface = -1;
    }
    if (!huge.empty())
        std::erase_if(lowered.spheres, [](const LoweredSphere& s) { return s.surface < 0; });
}

}  // namespace

void part_huge_spheres(const Vec3& eye, LoweredScene& lowered)
{
    Extent extent;
    extent.include(eye, 0.0);
    for (const Light& light : lowered.lights)
        if (light.type == LightType::point)
            extent.include(light.vector, 0.0);

    // A sphere that is not huge is part of the scene that later ones are held against.
    std::vector<std::uint32_t> huge;
    for (const std::uint32_t number : order_by_radius(lowered.spheres)) {
        const LoweredSphere& sphere = lowered.spheres[number];
        if (is_huge(sphere, extent))
            huge.push_back(number);
        else
            extent.include(sphere.center, sphere.radius);
    }
    std::sort(huge.begin(), huge.end());
    move_huge(huge, extent.middle(), lowered);
}

}  // namespace packtrace
