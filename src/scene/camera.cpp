#include <packtrace/camera.hpp>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <stdexcept>

namespace packtrace {
namespace {

// The width and height of the viewport at distance `camera.distance`.
Vec2 viewport_of(const Camera& camera, int width, int height)
{
    if (!camera.fov)
        return camera.viewport;
    const double tall = 2.0 * camera.distance * std::tan(glm::radians(*camera.fov) / 2.0);
    return {tall * width / height, tall};
}

}  // namespace

CameraBasis camera_basis(const Camera& camera, int width, int height)
{
    const Vec2 viewport = viewport_of(camera, width, height);
    return {.origin = camera.position,
            .right = camera.rotation[0] * (viewport.x / width),
            .up = camera.rotation[1] * (viewport.y / height),
            .forward = camera.rotation[2] * camera.distance};
}

Mat3 look_at(const Vec3& position, const Vec3& target, const Vec3& up)
{
    const Vec3 forward = target - position;
    const Vec3 right = glm::cross(up, forward);
    const double length = glm::length(right);
    if (!(length > 1e-12 * glm::length(up) * glm::length(forward)) || length == 0.0)
        throw std::invalid_argument("the view direction is zero or parallel to up");
    Mat3 rotation;
    rotation[0] = right / length;
    rotation[2] = glm::normalize(forward);
    rotation[1] = glm::cross(rotation[2], rotation[0]);
    return rotation;
}

}  // namespace packtrace
