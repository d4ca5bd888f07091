#include "lower/lower_surface.hpp"

#include <cmath>
#include <variant>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <packtrace/read_scene.hpp>

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

void lower_sphere(const Object& object, const Sphere& sphere, std::int32_t number,
                  LoweredScene& lowered)
{
    const double scale = similarity_scale(object.transform);
    if (scale == 0.0)
        throw SceneError("object '" + object.name +
                         "': the packet kernels know spheres under similarity transforms only; "
                         "use one factor for scale and no shear");
    LoweredSphere result;
    result.center = Vec3(object.transform * glm::dvec4(sphere.center, 1.0));
    result.radius = scale * sphere.radius;
    result.object = number;
    lowered.spheres.push_back(result);
}

void lower_plane(const Object& object, const Plane& plane, std::int32_t number,
                 LoweredScene& lowered)
{
    LoweredPlane result;
    result.point = Vec3(object.transform * glm::dvec4(plane.point, 1.0));
    const Mat3 normal_map = glm::transpose(glm::inverse(Mat3(object.transform)));
    result.normal = glm::normalize(normal_map * plane.normal);
    result.object = number;
    lowered.planes.push_back(result);
}

}  // namespace

void lower_surface(const Object& object, std::int32_t number, LoweredScene& lowered)
{
    if (const auto* sphere = std::get_if<Sphere>(&object.surface))
        lower_sphere(object, *sphere, number, lowered);
    else if (const auto* plane = std::get_if<Plane>(&object.surface))
        lower_plane(object, *plane, number, lowered);
    else
        throw SceneError("object '" + object.name +
                         "': the packet kernels know spheres and planes only; remove it");
}

}  // namespace packtrace
