#include "lab/stress/stress_family.hpp"

#include <limits>

#include <glm/geometric.hpp>

// Scenes of several objects.
namespace packtrace::lab {
namespace {

/// Note 001's scene from its own eye.
StressCase four_spheres(StressRandom&)
{
    StressCase result;
    result.scene.objects = {sphere_object({0, -1, 3}, 1), sphere_object({-2, 1, 3}, 1),
                            sphere_object({2, 1, 3}, 1), sphere_object({0, -5001, 0}, 5000)};
    result.ray = [](StressRandom& random) {
        const double x = random.between(-0.5, 0.5);
        const double y = random.between(-0.5, 0.5);
        return StressRay{Vec3(0.0), Vec3(x, y, 1.0), 1.0, std::numeric_limits<double>::infinity()};
    };
    return result;
}

/// Pairs of surfaces that lie within 1e-7 to 1e-3 of each other.
StressCase coincident(StressRandom& random)
{
    const Vec3 center = random.box(3.0);
    const double radius = random.between(0.5, 2.0);
    const double gap = radius * random.power(1e-7, 1e-3);
    StressCase result;
    result.scene.objects = {sphere_object(center, radius),
                            sphere_object(center + gap * random.unit(), radius + gap)};
    result.ray = [=](StressRandom& r) {
        const Vec3 org = center + r.unit() * (radius * r.between(1.5, 8.0));
        return ray_towards(org, center + radius * r.between(0.0, 1.2) * r.unit());
    };
    return result;
}

/// Balls from 1/1000 to 1000 on one ground.
StressCase all_scales(StressRandom& random)
{
    StressCase result;
    result.scene.objects = {sphere_object({0, -1e6, 0}, 1e6)};
    for (int power = -3; power <= 3; ++power) {
        const double radius = std::pow(10.0, power);
        const Vec3 place = 3.0 * radius * random.unit();
        result.scene.objects.push_back(sphere_object({place.x, radius, place.z}, radius));
    }
    result.scene.camera.position = {0.0, 1.0, -1.0};
    const auto objects = result.scene.objects;
    result.ray = [objects](StressRandom& r) {
        const auto& at =
            std::get<Sphere>(objects[static_cast<std::size_t>(1 + r.below(7))].surface);
        const Vec3 org = at.center + at.radius * r.between(1.1, 5.0) *
                                         glm::normalize(r.unit() + Vec3(0.0, 1.2, 0.0));
        return ray_towards(org, at.center + at.radius * r.between(0.0, 1.5) * r.unit());
    };
    return result;
}

/// A range that ends just before or just behind the surface.
StressCase short_ranges(StressRandom& random)
{
    const Vec3 center = random.box(3.0);
    StressCase result;
    result.scene.objects = {sphere_object(center, 1.0)};
    result.ray = [=](StressRandom& r) {
        const Vec3 outwards = r.unit();
        const Vec3 org = center + r.between(1.5, 8.0) * outwards;
        StressRay ray = ray_towards(org, center + outwards);
        ray.t_max = 1.0 + r.sign() * r.power(1e-7, 1e-2);
        return ray;
    };
    return result;
}

}  // namespace

std::vector<StressFamily> scene_families()
{
    return {
        {"four-spheres", "note 001's scene from its own eye", four_spheres},
        {"coincident", "two spheres within 1e-7 to 1e-3 of each other", coincident},
        {"scales", "balls of 1/1000 to 1000 on a ground of a million", all_scales},
        {"short-range", "t_max within 1e-7 to 1e-2 of a surface", short_ranges},
    };
}

}  // namespace packtrace::lab
