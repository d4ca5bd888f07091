#include "lab/stress/stress_family.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

// Scenes of several spheres: of any size and distance, and spheres that overlap, touch or nearly
// tie.
namespace packtrace::lab {
namespace {

/// Scenes of more spheres are for packet kernels only: kernels without a BVH would take minutes.
constexpr int most_scalar_spheres = 1000;

/// Note 001's scene from its own eye.
StressCase four_spheres(StressRandom&)
{
    StressCase result;
    result.scene.objects = {sphere_object({0, -1, 3}, 1), sphere_object({-2, 1, 3}, 1),
                            sphere_object({2, 1, 3}, 1), sphere_object({0, -5001, 0}, 5000)};
    result.ray = [](StressRandom& random) {
        const double x = random.between(-0.5, 0.5);
        const double y = random.between(-0.5, 0.5);
        return StressRay{Vec3(0.0), Vec3(x, y, 1.0), 1.0, no_end};
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

/// Ray intervals that end just before or just behind the surface.
StressCase short_ranges(StressRandom& random)
{
    const Vec3 center = random.box(3.0);
    return case_of({sphere_object(center, 1.0)}, [=](StressRandom& r) {
        const Vec3 outwards = r.unit();
        const Vec3 org = center + r.between(1.5, 8.0) * outwards;
        StressRay ray = ray_towards(org, center + outwards);
        ray.t_max = 1.0 + r.sign() * r.power(1e-7, 1e-2);
        return ray;
    });
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

namespace {

Sphere sphere_of(const Object& object)
{
    return std::get<Sphere>(object.surface);
}

/// A point of the circle where two spheres intersect, roughly on the side of `up`.
Vec3 crease_point(const Sphere& a, const Sphere& b, const Vec3& up, StressRandom& random)
{
    const Vec3 way = b.center - a.center;
    const double distance = glm::length(way);
    const Vec3 axis = way / distance;
    const double along =
        (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2.0 * distance);
    const double height = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
    const Vec3 turned = up + random.box(0.5);
    const Vec3 across_axis = glm::normalize(turned - glm::dot(turned, axis) * axis);
    return a.center + along * axis + height * across_axis;
}

/// A ray from `org` at a point, or past it by `least` to `most`.
StressRay near_point(StressRandom& random, const Vec3& org, const Vec3& point, double least,
                     double most)
{
    const double off = random.below(8) == 0 ? 0.0 : random.power(least, most);
    StressRay ray = ray_towards(org, point + off * random.unit());
    if (random.below(2) == 0)
        ray.dir = glm::normalize(ray.dir);
    return ray;
}

/// A layer of overlapping spheres, and rays from above at the circles where neighbours intersect.
StressCase creases(StressRandom& random, int count)
{
    const int edge = static_cast<int>(std::ceil(std::sqrt(count)));
    StressCase result;
    for (int i = 0; i < count; ++i) {
        const Vec3 place(i % edge - edge / 2, 0.2 * random.between(-1.0, 1.0), i / edge - edge / 2);
        result.scene.objects.push_back(
            sphere_object(place + 0.2 * random.box(1.0), random.between(0.7, 0.9)));
    }
    result.scene.camera.position = {0.0, 5.0, 0.0};
    result.ray = [count, edge, objects = result.scene.objects](StressRandom& r) {
        const int i = r.below(count - 1);
        const int j = i % edge + 1 < edge || i + edge >= count ? i + 1 : i + edge;
        const Vec3 point =
            crease_point(sphere_of(objects[static_cast<std::size_t>(i)]),
                         sphere_of(objects[static_cast<std::size_t>(j)]), {0.0, 1.0, 0.0}, r);
        const Vec3 org = point + r.power(2.0, 50.0) * glm::normalize(r.box(0.7) + Vec3(0, 1, 0));
        return near_point(r, org, point, 1e-9, 1e-3);
    };
    return result;
}

/// Two spheres that touch, and rays at their contact.
StressCase contact(StressRandom& random)
{
    const Vec3 center = random.box(3.0);
    const double radius = random.between(0.3, 2.0);
    const double other = radius * random.power(1.0, 1e4);
    const Vec3 way = random.unit();
    StressCase result;
    result.scene.objects = {sphere_object(center, radius),
                            sphere_object(center + (radius + other) * way, other)};
    result.scene.camera.position = center - 5.0 * way;
    result.ray = [=](StressRandom& r) {
        const Vec3 point = center + radius * way;
        // From the side of the smaller sphere, through the wedge between both.
        const Vec3 from = glm::normalize(across(r, way) - r.power(1e-3, 1.0) * way);
        return near_point(r, point + r.between(2.0, 10.0) * radius * from, point, 1e-8, 1e-1);
    };
    return result;
}

/// A sphere that stands a little in the ground, and rays whose hits with both are nearly equal.
StressCase near_tie(StressRandom& random)
{
    const double ground = random.power(10.0, 1e5);
    const double radius = random.between(0.3, 2.0);
    const Vec3 center(random.between(-1.0, 1.0), radius * random.between(0.2, 0.95), 3.0);
    StressCase result;
    result.scene.objects = {sphere_object(center, radius),
                            sphere_object({0.0, -ground, 0.0}, ground)};
    result.scene.camera.position = {0.0, 1.0, -2.0};
    result.ray = [objects = result.scene.objects](StressRandom& r) {
        const Vec3 point =
            crease_point(sphere_of(objects[0]), sphere_of(objects[1]), {0.0, 0.0, -1.0}, r);
        const Vec3 org = point + r.between(1.0, 10.0) * glm::normalize(r.unit() + Vec3(0, 1.1, -1));
        return near_point(r, org, point, 1e-10, 1e-5);
    };
    return result;
}

StressCase known_tie()
{
    return known_case({sphere_object({0, -1, 3}, 1), sphere_object({0, -5001, 0}, 5000)},
                      {{0, 0, 0}, {-0.019999999552965164, -0.5, 1}, 0.0, no_end});
}

StressFamily crease_family(const char* name, const char* what, int count, int scenes)
{
    return {.name = name,
            .what = what,
            .make = [=](StressRandom& random) { return creases(random, count); },
            .scenes = scenes,
            .packets_only = count > most_scalar_spheres};
}

}  // namespace

std::vector<StressFamily> touching_families()
{
    return {
        crease_family("creases-10", "where 10 overlapping spheres cross", 10, 16),
        crease_family("creases-100", "where 100 overlapping spheres cross", 100, 8),
        crease_family("creases-1000", "where 1000 overlapping spheres cross", 1000, 4),
        crease_family("creases-10000", "where 10 000 overlapping spheres cross", 10000, 1),
        {"contacts", "where two spheres touch", contact},
        {"near-ties",
         "where a sphere stands in the ground, hits of both 1e-10 to 1e-5 apart",
         near_tie,
         {known_tie}},
    };
}

}  // namespace packtrace::lab
