#include "lower/lower_surface.hpp"

#include <cmath>
#include <variant>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lower/lower_quadric.hpp"

namespace packtrace {
namespace {

/// The factor of a similarity transform, or 0 when angles or ratios of lengths change.
double similarity_scale(const Mat4& transform)
{
    const Mat3 linear(transform);
    const Mat3 square = glm::transpose(linear) * linear;
    const double scale2 = (square[0][0] + square[1][1] + square[2][2]) / 3.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) {
            const double expected = column == row ? scale2 : 0.0;
            if (std::abs(square[column][row] - expected) > 1e-12 * scale2)
                return 0.0;
        }
    return std::sqrt(scale2);
}

/// Under a similarity a sphere stays one; false when it does not.
bool lower_sphere(const Sphere& sphere, const Mat4& transform, std::int32_t surface,
                  LoweredScene& lowered)
{
    const double scale = similarity_scale(transform);
    if (scale == 0.0)
        return false;
    LoweredSphere result;
    result.center = Vec3(transform * glm::dvec4(sphere.center, 1.0));
    result.radius = scale * sphere.radius;
    result.surface = surface;
    lowered.spheres.push_back(result);
    return true;
}

int lower_kind(const Object& object, const Sphere& sphere, std::int32_t surface,
               LoweredScene& lowered)
{
    if (!lower_sphere(sphere, object.transform, surface, lowered)) {
        // Moved to its own centre first, so that no digits are lost to it.
        Object centered = object;
        centered.transform[3] = object.transform * glm::dvec4(sphere.center, 1.0);
        lowered.quadrics.push_back(
            lower_quadric(centered, as_quadric({Vec3(0.0), sphere.radius}), surface));
    }
    return 1;
}

int lower_kind(const Object& object, const Plane& plane, std::int32_t surface,
               LoweredScene& lowered)
{
    LoweredPlane result;
    result.point = Vec3(object.transform * glm::dvec4(plane.point, 1.0));
    const Mat3 normal_map = glm::transpose(glm::inverse(Mat3(object.transform)));
    result.normal = glm::normalize(normal_map * plane.normal);
    result.surface = surface;
    lowered.planes.push_back(result);
    return 1;
}

int lower_kind(const Object& object, const Quadric& quadric, std::int32_t surface,
               LoweredScene& lowered)
{
    const bool unit_sphere = quadric.kind == QuadricKind::ellipsoid && !quadric.z_range;
    if (unit_sphere && lower_sphere(Sphere{}, object.transform, surface, lowered))
        return 1;
    lowered.quadrics.push_back(lower_quadric(object, quadric, surface));
    return quadric.capped ? 3 : 1;
}

}  // namespace

int lower_surface(const Object& object, std::int32_t surface, LoweredScene& lowered)
{
    return std::visit([&](const auto& kind) { return lower_kind(object, kind, surface, lowered); },
                      object.surface);
}

}  // namespace packtrace
