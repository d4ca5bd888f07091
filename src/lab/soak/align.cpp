#include "lab/soak/soak_scene.hpp"
#include "lab/stress/placed_quadric.hpp"
#include "scene/vectors.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace packtrace::lab {
namespace {

/// The grid's step is about this share of the distance from the camera to the first object.
constexpr double steps_to_object = 8.0;

/// The grid's step if there is no such distance.
constexpr double default_step = 0.5;

Vec3 place_of(const Object& object)
{
    const auto* const sphere = std::get_if<Sphere>(&object.surface);
    const auto* const plane = std::get_if<Plane>(&object.surface);
    const Vec3 own = sphere != nullptr  ? sphere->center
                     : plane != nullptr ? plane->point
                                        : Vec3(0.0);
    return to_world(object.transform, own);
}

double power_of_two(double value)
{
    return std::exp2(std::round(std::log2(value)));
}

/// The nearest direction along an axis or a diagonal.
Vec3 on_axes(const Vec3& direction)
{
    return glm::round(direction / largest_component(direction));
}

/// The nearest turn that takes axes to axes, mirrored if `turn` is.
Mat3 on_axes(const Mat3& turn)
{
    Mat3 nearest(0.0);
    int taken = -1;
    for (int column = 0; column < 2; ++column) {
        int most = taken == 0 ? 1 : 0;
        for (int row = 0; row < 3; ++row)
            if (row != taken && std::abs(turn[column][row]) > std::abs(turn[column][most]))
                most = row;
        nearest[column][most] = turn[column][most] < 0.0 ? -1.0 : 1.0;
        taken = most;
    }
    nearest[2] = glm::cross(nearest[0], nearest[1]);
    if (glm::determinant(turn) < 0.0)
        nearest[2] = -nearest[2];
    return nearest;
}

double whole_steps(double value, double step)
{
    return std::max(step, step * std::round(value / step));
}

void align_surface(Sphere& sphere, double step)
{
    sphere.center = on_grid(sphere.center, step);
    sphere.radius = whole_steps(sphere.radius, step);
}

void align_surface(Plane& plane, double step)
{
    plane.point = on_grid(plane.point, step);
    plane.normal = glm::normalize(on_axes(plane.normal));
    plane_axes(plane);
}

void align_surface(Quadric& quadric, double)
{
    for (double& coefficient : quadric.coefficients)
        coefficient = std::round(coefficient);
    if (quadric.z_range) {
        quadric.z_range->low = 0.5 * std::round(2.0 * quadric.z_range->low);
        quadric.z_range->high =
            quadric.z_range->low + whole_steps(quadric.z_range->high - quadric.z_range->low, 0.5);
    }
}

void align_surface(Polygon& polygon, double)
{
    for (auto& contour : polygon.contours)
        for (Vec3& corner : contour)
            corner = on_grid(corner, 0.25);
}

/// An identity stays an identity, as spheres with a centre have no other transform.
void align_transform(Mat4& transform, double step)
{
    if (transform == Mat4(1.0))
        return;
    const Mat3 turn = on_axes(Mat3(transform));
    const Vec3 to = on_grid(Vec3(transform[3]), step);
    for (int column = 0; column < 3; ++column) {
        const double size = glm::length(Vec3(transform[column]));
        transform[column] = glm::dvec4(power_of_two(size) * turn[column], 0.0);
    }
    transform[3] = glm::dvec4(to, 1.0);
}

}  // namespace

double grid_step(const Scene& scene)
{
    double distance = 0.0;
    if (!scene.objects.empty())
        distance = glm::length(place_of(scene.objects.front()) - scene.camera.position);
    return distance > 0.0 && std::isfinite(distance) ? power_of_two(distance / steps_to_object)
                                                     : default_step;
}

Vec3 on_grid(const Vec3& value, double step)
{
    return step * glm::round(value / step);
}

void align(Scene& scene)
{
    const double step = grid_step(scene);
    for (Object& object : scene.objects) {
        align_transform(object.transform, step);
        std::visit([&](auto& surface) { align_surface(surface, step); }, object.surface);
    }
    for (Light& light : scene.lights) {
        if (light.type == LightType::point)
            light.vector = on_grid(light.vector, step);
        if (light.type == LightType::directional)
            light.vector = on_axes(light.vector);
    }
    Camera& camera = scene.camera;
    camera.position = on_grid(camera.position, step);
    camera.rotation = on_axes(camera.rotation);
    camera.fov.reset();
    camera.viewport = Vec2(1.0);
    camera.distance = 1.0;
    camera.pixel_sample = glm::round(2.0 * camera.pixel_sample) * 0.5;
}

}  // namespace packtrace::lab
