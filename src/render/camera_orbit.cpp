#include "render/camera_orbit.hpp"

#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/unit_vector.hpp"

namespace packtrace {
namespace {

// Upwards as the scene's camera has it, so that a camera which looks at the centre keeps its pose.
Vec3 upwards(const Camera& start, const Vec3& view)
{
    const Vec3& up = start.rotation[1];
    const bool along = glm::length(glm::cross(up, language::unit_vector(view))) < 1e-6;
    return along ? start.rotation[2] : up;
}

}  // namespace

Camera orbit_camera(const Camera& start, const Orbit& orbit, double share)
{
    const Vec3 arm = start.position - orbit.center;
    const Vec3 axis = language::unit_vector(orbit.axis);
    const Mat3 turn(glm::rotate(Mat4(1.0), glm::radians(orbit.degrees * share), axis));
    Camera camera = start;
    camera.position = orbit.center + turn * arm;
    camera.rotation = turn * look_at(start.position, orbit.center, upwards(start, arm));
    return camera;
}

}  // namespace packtrace
