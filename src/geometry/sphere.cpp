#include "geometry/sphere.hpp"

#include "geometry/kinds.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace packtrace {
namespace {

/// A sphere is anchored if its radius is more than this many times the distance of its surface from
/// the world's origin. At this ratio both forms are about equally exact (the study of formulas in
/// docs/numerics_derivations.md). Only the sphere decides, so other objects of a scene do not
/// change a digit.
constexpr double anchored_ratio = 64.0;
/// A smaller sphere is not anchored. It is a ball rather than a ground, and balls are often near
/// the world's origin. As a plain sphere it loses no more digits than its neighbours, and it can be
/// in the bvh.
constexpr double smallest_anchored = 4.0;

/// The largest relative difference of squared lengths under a similarity. Rounding of a few
/// rotations and factors stays within it. A transform with a larger difference makes an ellipsoid,
/// even if only double can distinguish it from a sphere.
constexpr double similarity_rounding = 0x1p-49;

/// The point of the surface nearest to the world's origin.
Vec3 anchor_of(const LoweredSphere& sphere)
{
    const double distance = glm::length(sphere.center);
    if (distance == 0.0)
        return {0.0, sphere.radius, 0.0};
    return sphere.center - sphere.center * (sphere.radius / distance);
}

/// The scale of a similarity; 0 for other transforms.
double similarity_scale(const Mat4& transform)
{
    const Mat3 linear(transform);
    const Mat3 square = glm::transpose(linear) * linear;
    const double scale2 = (square[0][0] + square[1][1] + square[2][2]) / 3.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) {
            const double expected = column == row ? scale2 : 0.0;
            if (std::abs(square[column][row] - expected) > similarity_rounding * scale2)
                return 0.0;
        }
    return std::sqrt(scale2);
}

}  // namespace

bool is_anchored(const LoweredSphere& sphere)
{
    if (sphere.radius <= smallest_anchored)
        return false;
    // Most spheres are far from anchored. This test needs no square root.
    const double reach = sphere.radius * (1.0 + 2.0 / anchored_ratio);
    if (glm::dot(sphere.center, sphere.center) > reach * reach)
        return false;
    return sphere.radius > anchored_ratio * glm::length(anchor_of(sphere));
}

bool lower_sphere(const Sphere& sphere, const Mat4& transform, std::int32_t surface,
                  SurfaceLists& lists)
{
    const double scale = similarity_scale(transform);
    if (scale == 0.0)
        return false;
    LoweredSphere result{.center = Vec3(transform * glm::dvec4(sphere.center, 1.0)),
                         .radius = scale * sphere.radius,
                         .surface = surface};
    lists.spheres.push_back(result);
    return true;
}

int lower_kind(const Object& object, const Sphere& sphere, std::int32_t surface,
               SurfaceLists& lists)
{
    if (!lower_sphere(sphere, object.transform, surface, lists)) {
        // Transform the centre first, so that no digits are lost.
        Object centered = object;
        centered.transform[3] = object.transform * glm::dvec4(sphere.center, 1.0);
        lists.quadrics.push_back(
            lower_quadric(centered, as_quadric({Vec3(0.0), sphere.radius}), surface));
    }
    return 1;
}

void part_anchored_spheres(SurfaceLists& lists)
{
    const auto first =
        std::stable_partition(lists.spheres.begin(), lists.spheres.end(),
                              [](const LoweredSphere& sphere) { return !is_anchored(sphere); });
    for (auto sphere = first; sphere != lists.spheres.end(); ++sphere)
        lists.anchored_spheres.push_back(
            {sphere->center, sphere->radius, anchor_of(*sphere), sphere->surface});
    lists.spheres.erase(first, lists.spheres.end());
}

abi::SphereShape shape_of(const LoweredSphere& sphere)
{
    abi::SphereShape shape;
    round_to(shape.center, sphere.center);
    shape.radius = sphere.radius;
    return shape;
}

template <class Real>
double center_error(const LoweredSphere& sphere)
{
    Real rounded[3];
    round_to(rounded, sphere.center);
    return 1.000001 * glm::length(widen(rounded) - sphere.center);
}

/// The curvature form around the rounded anchor. The offset corrects for the rounding of the
/// anchor.
template <class Real>
abi::AnchoredSphere<Real> pack(const LoweredAnchoredSphere& sphere)
{
    abi::AnchoredSphere<Real> packed;
    round_to(packed.anchor, sphere.anchor);
    const Vec3 outwards = widen(packed.anchor) - sphere.center;
    const double distance = glm::length(outwards);
    round_to(packed.normal, outwards / sphere.radius);
    packed.curvature = static_cast<Real>(1.0 / sphere.radius);
    packed.offset =
        static_cast<Real>((distance - sphere.radius) * (distance + sphere.radius) / sphere.radius);
    round_to(packed.center, sphere.center);
    packed.radius = static_cast<Real>(sphere.radius);
    packed.surface = sphere.surface;
    return packed;
}

template double center_error<float>(const LoweredSphere&);
template double center_error<double>(const LoweredSphere&);
template abi::AnchoredSphere<float> pack(const LoweredAnchoredSphere&);
template abi::AnchoredSphere<double> pack(const LoweredAnchoredSphere&);

}  // namespace packtrace
