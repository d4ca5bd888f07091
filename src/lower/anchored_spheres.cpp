#include <algorithm>

#include <glm/geometric.hpp>

#include "lower/lower_surface.hpp"

namespace packtrace {
namespace {

/// How many times the distance of its surface from the world's origin a sphere's radius must be;
/// from the study of formulas in docs/numerics_derivations.md, where both forms are about as exact
/// at this ratio. The sphere alone decides, so that nothing else of a scene changes a digit.
constexpr double anchored_ratio = 64.0;

/// The point of the surface nearest the world's origin.
Vec3 anchor_of(const LoweredSphere& sphere)
{
    const double distance = glm::length(sphere.center);
    if (distance == 0.0)
        return {0.0, sphere.radius, 0.0};
    return sphere.center - sphere.center * (sphere.radius / distance);
}

bool is_anchored(const LoweredSphere& sphere)
{
    // Most spheres are not by far, which costs no square root.
    const double reach = sphere.radius * (1.0 + 2.0 / anchored_ratio);
    if (glm::dot(sphere.center, sphere.center) > reach * reach)
        return false;
    return sphere.radius > anchored_ratio * glm::length(anchor_of(sphere));
}

}  // namespace

void part_anchored_spheres(LoweredScene& lowered)
{
    const auto first =
        std::stable_partition(lowered.spheres.begin(), lowered.spheres.end(),
                              [](const LoweredSphere& sphere) { return !is_anchored(sphere); });
    for (auto sphere = first; sphere != lowered.spheres.end(); ++sphere)
        lowered.anchored_spheres.push_back(
            {sphere->center, sphere->radius, anchor_of(*sphere), sphere->surface});
    lowered.spheres.erase(first, lowered.spheres.end());
}

}  // namespace packtrace
