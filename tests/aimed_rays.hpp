#pragma once

#include "lab/stress/placed_quadric.hpp"
#include "lab/stress/stress_family.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

// Rays aimed at the places where small errors decide between hit and miss: silhouettes, planes at
// grazing angles, creases and rims. They pass their target at 3e-8 to 1e-3 of its size.
namespace packtrace::test {

using lab::StressRandom;
using lab::StressRay;

struct AimedRays {
    Scene scene;
    std::vector<StressRay> rays;
};

struct AimedFamily {
    std::string name;
    /// Makes a scene with this number of rays.
    std::function<AimedRays(StressRandom&, int)> make;
};

/// The signed distance between a ray and its target, as a share of the target's size.
[[nodiscard]] inline double aim_error(StressRandom& random)
{
    return random.sign() * random.power(3e-8, 1e-3);
}

/// A ray whose line passes the centre at `distance`.
[[nodiscard]] inline StressRay ray_past(StressRandom& random, const Vec3& org, const Vec3& center,
                                        double distance)
{
    const Vec3 towards = glm::normalize(center - org);
    const double sine = std::min(distance / glm::length(center - org), 1.0);
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    return lab::ray_towards(org, org + cosine * towards + sine * lab::across(random, towards));
}

/// Rays that all start at one origin, or each at its own.
[[nodiscard]] inline std::vector<StressRay> aim_from(
    StressRandom& random, int count, const std::function<Vec3()>& origin,
    const std::function<StressRay(const Vec3&)>& aim)
{
    const bool shared = random.below(2) == 0;
    // Rounded to float, as the kernels get the origin.
    const auto rounded = [&] { return Vec3(glm::vec3(origin())); };
    const Vec3 first = rounded();
    std::vector<StressRay> rays;
    for (int i = 0; i < count; ++i)
        rays.push_back(aim(shared ? first : rounded()));
    return rays;
}

/// Rays past the silhouettes of spheres of one size, from at most `far` sizes away.
[[nodiscard]] inline AimedRays past_spheres(StressRandom& random, int count, int spheres,
                                            double far)
{
    AimedRays result;
    const double distance = random.power(2.0, far);
    for (int i = 0; i < spheres; ++i)
        result.scene.objects.push_back(
            lab::sphere_object(random.box(0.3 * spheres), random.between(0.2, 2.0)));
    const Vec3 away = distance * random.unit();
    result.rays = aim_from(
        random, count, [&] { return away + random.box(1.0); },
        [&](const Vec3& org) {
            const Object& object =
                result.scene.objects[static_cast<std::size_t>(random.below(spheres))];
            const auto& sphere = std::get<Sphere>(object.surface);
            return ray_past(random, org, sphere.center, sphere.radius * (1.0 + aim_error(random)));
        });
    return result;
}

/// Rays in all directions that start close to the surfaces of overlapping spheres, inside or
/// outside.
[[nodiscard]] inline AimedRays off_spheres(StressRandom& random, int count)
{
    AimedRays result;
    const int spheres = 60;
    const Vec3 middle = random.power(0.1, 100.0) * random.unit();
    for (int i = 0; i < spheres; ++i)
        result.scene.objects.push_back(
            lab::sphere_object(middle + random.box(3.0), random.between(0.2, 1.0)));
    for (int i = 0; i < count; ++i) {
        const Object& object =
            result.scene.objects[static_cast<std::size_t>(random.below(spheres))];
        const auto& sphere = std::get<Sphere>(object.surface);
        const Vec3 org = sphere.center + sphere.radius * (1.0 + aim_error(random)) * random.unit();
        result.rays.push_back(lab::ray_towards(org, org + random.unit()));
    }
    return result;
}

/// Rays along the horizon of a ground sphere with balls on it.
[[nodiscard]] inline AimedRays past_ground(StressRandom& random, int count)
{
    AimedRays result;
    const double radius = random.power(100.0, 1e6);
    const Vec3 center(0.0, random.between(-2.0, 0.0) - radius, 0.0);
    result.scene.objects.push_back(lab::sphere_object(center, radius));
    for (int i = 0; i < 3; ++i) {
        const Vec3 up = glm::normalize(random.box(10.0) - center);
        const double size = random.between(0.2, 2.0);
        result.scene.objects.push_back(lab::sphere_object(center + (radius + size) * up, size));
    }
    const auto above = [&] {
        const Vec3 up = glm::normalize(random.box(10.0) - center);
        return center + (radius + random.power(0.01, 30.0)) * up;
    };
    result.rays = aim_from(random, count, above, [&](const Vec3& org) {
        // The error is a share of the eye's height above the ground: a share of the ground's radius
        // could exceed that height.
        const double drop = glm::length(org - center) - radius;
        return ray_past(random, org, center, radius + drop * aim_error(random));
    });
    return result;
}

/// Rays at the circles in which spheres intersect.
[[nodiscard]] inline AimedRays at_creases(StressRandom& random, int count)
{
    AimedRays result;
    const double first_radius = random.power(0.5, 5000.0);
    const Vec3 first(0.0, -first_radius, 0.0);
    const double second_radius = random.between(0.3, 1.0);
    const Vec3 way = glm::normalize(Vec3(0.0, 1.0, 0.0) + 0.1 * random.box(1.0));
    const Vec3 second = first + (first_radius + 0.5 * second_radius) * way;
    result.scene.objects = {lab::sphere_object(first, first_radius),
                            lab::sphere_object(second, second_radius)};
    // The height of the circle's plane above the first centre.
    const double apart = glm::length(second - first);
    const double height =
        (apart * apart + first_radius * first_radius - second_radius * second_radius) /
        (2.0 * apart);
    const double size = std::sqrt((first_radius - height) * (first_radius + height));
    result.rays = aim_from(
        random, count, [&] { return second + random.between(2.0, 9.0) * random.unit(); },
        [&](const Vec3& org) {
            const Vec3 target = first + height * way + size * lab::across(random, way);
            return lab::ray_towards(org, target + aim_error(random) * random.unit());
        });
    return result;
}

/// Rays at grazing angles (sines from 3e-8 to 1e-3) to planes, two of which intersect.
[[nodiscard]] inline AimedRays along_planes(StressRandom& random, int count)
{
    AimedRays result;
    const Vec3 point = random.power(0.1, 1e4) * random.unit();
    Vec3 normals[2] = {random.unit(), random.unit()};
    for (Vec3& normal : normals) {
        normal = glm::normalize(normal);
        result.scene.objects.push_back(lab::plane_object(point, normal));
    }
    result.rays = aim_from(
        random, count, [&] { return point + random.box(10.0); },
        [&](const Vec3& org) {
            const Vec3& normal = normals[random.below(2)];
            const Vec3 way = lab::across(random, normal) + aim_error(random) * normal;
            return lab::ray_towards(org, org + way);
        });
    return result;
}

/// A quadric of any kind, rotated, scaled and translated.
[[nodiscard]] inline Object placed_quadric(StressRandom& random, QuadricKind kind)
{
    Object object{.surface = packtrace::quadric(kind)};
    const double thin = random.below(2) == 0 ? 1.0 : random.power(1e-3, 1.0);
    Mat4 transform = glm::translate(Mat4(1.0), random.power(0.1, 100.0) * random.unit());
    transform = glm::rotate(transform, random.between(0.0, 6.28), random.unit());
    object.transform =
        glm::scale(transform, Vec3(random.between(0.5, 2.0), random.between(0.5, 2.0), thin));
    return object;
}

[[nodiscard]] inline Vec3 placed(const Object& object, const Vec3& own)
{
    return Vec3(object.transform * glm::dvec4(own, 1.0));
}

/// Rays along tangents of quadrics, moved off or into the surface.
[[nodiscard]] inline AimedRays along_quadrics(StressRandom& random, int count)
{
    AimedRays result;
    const auto kind = static_cast<QuadricKind>(random.below(7));
    const Object object = placed_quadric(random, kind);
    result.scene.objects = {object};
    for (int i = 0; i < count; ++i) {
        const Vec3 own = lab::own_surface_point(random, kind);
        // A second point of the surface close by gives the tangent, without a gradient.
        const Vec3 at = placed(object, own);
        const auto& c = std::get<Quadric>(object.surface).coefficients;
        const Vec3 gradient(2.0 * c[0] * own.x + c[6], 2.0 * c[1] * own.y + c[7],
                            2.0 * c[2] * own.z + c[8]);
        const Vec3 normal =
            glm::normalize(glm::transpose(glm::inverse(Mat3(object.transform))) * gradient);
        const Vec3 way = lab::across(random, normal);
        const Vec3 moved = at + aim_error(random) * normal;
        const Vec3 org(glm::vec3(moved - random.power(0.5, 20.0) * way));
        result.rays.push_back(lab::ray_towards(org, moved));
    }
    return result;
}

/// Rays at the rims of capped and of open cylinders and cones, from outside and inside.
[[nodiscard]] inline AimedRays at_rims(StressRandom& random, int count)
{
    AimedRays result;
    const QuadricKind kind = random.below(2) == 0 ? QuadricKind::cylinder : QuadricKind::cone;
    Object object = placed_quadric(random, kind);
    auto& quadric = std::get<Quadric>(object.surface);
    quadric.z_range = ZRange{0.25, 1.0};
    quadric.capped = random.below(2) == 0;
    result.scene.objects = {object};
    result.rays = aim_from(
        random, count,
        [&] { return placed(object, Vec3(0.0, 0.0, 0.5) + random.box(random.below(2) * 3 + 0.1)); },
        [&](const Vec3& org) {
            const double turn = random.between(0.0, 6.2831853);
            const double z = random.below(2) == 0 ? 0.25 : 1.0;
            const double radius = kind == QuadricKind::cone ? z : 1.0;
            const Vec3 rim(radius * std::cos(turn), radius * std::sin(turn), z);
            return lab::ray_towards(org, placed(object, rim + aim_error(random) * random.unit()));
        });
    return result;
}

[[nodiscard]] inline std::vector<AimedFamily> aimed_families()
{
    return {
        {"spheres", [](StressRandom& r, int n) { return past_spheres(r, n, 3, 1e2); }},
        {"far spheres", [](StressRandom& r, int n) { return past_spheres(r, n, 3, 1e5); }},
        {"many spheres", [](StressRandom& r, int n) { return past_spheres(r, n, 40, 1e2); }},
        {"off spheres", off_spheres},
        {"ground spheres", past_ground},
        {"creases", at_creases},
        {"planes", along_planes},
        {"quadrics", along_quadrics},
        {"rims", at_rims},
    };
}

}  // namespace packtrace::test
