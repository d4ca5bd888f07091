#include "lower/eye_glass.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace packtrace {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Where a line from inside leaves again, as a t; nothing from outside.
using Exit = std::optional<double>;

double first_positive(double a, double b, double c)
{
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

Exit exit_of_sphere(const Vec3& center, double radius, const Vec3& eye, const Vec3& forward)
{
    const Vec3 o = eye - center;
    const double c = glm::dot(o, o) - radius * radius;
    if (!(c < 0.0))
        return std::nullopt;
    return first_positive(glm::dot(forward, forward), glm::dot(o, forward), c);
}

Exit exit_of(const LoweredSphere& sphere, const Vec3& eye, const Vec3& forward)
{
    return exit_of_sphere(sphere.center, sphere.radius, eye, forward);
}

Exit exit_of(const LoweredAnchoredSphere& sphere, const Vec3& eye, const Vec3& forward)
{
    return exit_of_sphere(sphere.center, sphere.radius, eye, forward);
}

Exit exit_of(const LoweredPlane& plane, const Vec3& eye, const Vec3& forward)
{
    const double height = glm::dot(plane.normal, eye - plane.point);
    if (!(height < 0.0))
        return std::nullopt;
    const double t = -height / glm::dot(plane.normal, forward);
    return t > 0.0 ? t : never;
}

Exit exit_of(const LoweredQuadric& quadric, const Vec3& eye, const Vec3& forward)
{
    const Vec3 p = quadric.inverse * (eye - quadric.center);
    const Vec3 v = quadric.inverse * forward;
    const double value =
        glm::dot(quadric.square * p, p) + 2.0 * quadric.linear * p.z + quadric.constant;
    const double height = glm::dot(quadric.clip, eye - quadric.center) + quadric.clip_offset;
    if (!(value < 0.0 && height > quadric.clip_low && height < quadric.clip_high))
        return std::nullopt;
    double first = first_positive(glm::dot(quadric.square * v, v),
                                  glm::dot(quadric.square * p, v) + quadric.linear * v.z, value);
    const double climb = glm::dot(quadric.clip, forward);
    for (const double end : {quadric.clip_low, quadric.clip_high})
        if (const double t = (end - height) / climb; t > 0.0)
            first = std::min(first, t);
    return first;
}

}  // namespace

std::vector<std::int32_t> glass_around(const Vec3& eye, const Vec3& forward,
                                       const LoweredScene& lowered)
{
    std::vector<std::pair<double, std::int32_t>> exits;
    const auto look = [&](const auto& surfaces) {
        for (const auto& surface : surfaces) {
            const auto& index = lowered.material_index[static_cast<std::size_t>(surface.surface)];
            const auto& material = lowered.materials[static_cast<std::size_t>(index.first)];
            if (material.transmit == Rgb(0.0))
                continue;
            if (const Exit exit = exit_of(surface, eye, forward))
                exits.emplace_back(*exit, index.object);
        }
    };
    look(lowered.spheres);
    look(lowered.anchored_spheres);
    look(lowered.planes);
    look(lowered.quadrics);
    std::sort(exits.begin(), exits.end());
    // Of too many, the outermost are remembered, as if the ray had entered them one by one.
    const std::size_t depth = abi::glass_depth;
    const std::size_t skip = exits.size() > depth ? exits.size() - depth : 0;
    std::vector<std::int32_t> inside;
    for (std::size_t i = skip; i < exits.size(); ++i)
        inside.push_back(exits[i].second);
    return inside;
}

}  // namespace packtrace
