#include "lab/stress/placed_quadric.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

// Small, thin and huge objects, seen from far away.
namespace packtrace::lab {
namespace {

/// A sphere so small and far away that both hits of a ray have the same t in single precision.
StressCase tiny_sphere(StressRandom& random)
{
    const double distance = random.power(1.0, 1e4);
    const double radius = distance * random.power(1e-9, 3e-7);
    const Vec3 org = random.below(2) == 0 ? Vec3(0.0) : random.box(1.0);
    const Vec3 center = org + distance * random.unit();
    return case_of({sphere_object(center, radius)}, [=](StressRandom& r) {
        return ray_towards(org, center + 1.1 * radius * r.between(0.0, 1.0) * r.unit());
    });
}

StressCase known_tiny_sphere()
{
    return known_case({sphere_object({0, 0, 10000}, 0.0003)},
                      {{0, 0, 0}, {1e-8, 1e-8, 1}, 0.0, no_end});
}

/// The planes z² = 1 of own space.
Quadric slab()
{
    return {.coefficients = {0, 0, 1, 0, 0, 0, 0, 0, 0, -1}};
}

/// Rays from far away at the middle of a quadric that is thin along one axis.
StressCase thin(StressRandom& random, const Quadric& quadric, double least, double most)
{
    const double half = random.power(least, most);
    const Mat4 transform = glm::translate(Mat4(1.0), random.box(3.0)) * any_turn(random) *
                           glm::scale(Mat4(1.0), {1.0, 1.0, half});
    StressCase result = placed(quadric, transform, {});
    result.ray = [=](StressRandom& r) {
        const Vec3 aim = to_world(transform, {r.between(-1.1, 1.1), r.between(-1.1, 1.1), 0.0});
        StressRay ray = ray_towards(aim + r.power(10.0, 1e4) * r.unit(), aim);
        ray.dir = glm::normalize(ray.dir);
        return ray;
    };
    return result;
}

StressCase known_pancake()
{
    Object pancake{.surface = packtrace::quadric(QuadricKind::ellipsoid),
                   .transform = glm::translate(Mat4(1.0), Vec3(0, 0, 50)) *
                                glm::scale(Mat4(1.0), Vec3(1, 1, 1e-6))};
    return known_case({pancake}, {{0, 0, 0}, {1e-3, 2e-3, 1}, 0.0, no_end});
}

/// Long rays between two planes, nearly along them.
StressCase inside_slab(StressRandom& random)
{
    const Mat4 turn = random.below(4) == 0
                          ? glm::rotate(Mat4(1.0), glm::radians(30.0), Vec3(1, 0, 0))
                          : any_turn(random);
    return placed(slab(), turn, [](StressRandom& r) {
        const double angle = r.angle();
        const Vec3 org(r.between(-2.0, 2.0), r.between(-2.0, 2.0), r.between(-0.9, 0.9));
        const double rise = r.sign() * r.power(1e-6, 1.0);
        return ray_towards(org, org + Vec3(std::cos(angle), std::sin(angle), rise));
    });
}

Vec3 horizontal(StressRandom& random)
{
    const double turn = random.angle();
    return {std::cos(turn), 0.0, std::sin(turn)};
}

/// From a height over a ground sphere, whose top is the origin, to points from below the eye to a
/// little past the horizon.
StressRay to_ground(StressRandom& random, double radius, double height)
{
    const double horizon = std::acos(radius / (radius + height));
    const double share = random.below(2) == 0 ? random.power(1e-4, 1.0)
                                              : 1.0 + random.sign() * random.power(1e-7, 0.05);
    const double angle = share * horizon;
    const Vec3 point = radius * std::sin(angle) * horizontal(random) -
                       Vec3(0.0, 2.0 * radius * std::pow(std::sin(angle / 2.0), 2.0), 0.0);
    const Vec3 org(0.0, height, 0.0);
    StressRay ray = ray_towards(org + random.box(0.5 * std::min(1.0, height)), point);
    ray.dir = glm::normalize(ray.dir);
    return ray;
}

/// A ground sphere, and eyes at every height.
StressCase ground_eyes(StressRandom& random)
{
    const double radius = random.power(1e2, 1e7);
    StressCase result;
    result.scene.objects = {sphere_object({0.0, -radius, 0.0}, radius)};
    result.scene.camera.position = {0.0, random.power(1.0, 1e6), 0.0};
    result.ray = [=](StressRandom& r) { return to_ground(r, radius, r.power(1.0, 1e6)); };
    return result;
}

Light far_light(StressRandom& random)
{
    Light light{
        .type = LightType::point,
        .vector = random.power(1.0, 1e6) * glm::normalize(random.unit() + Vec3(0.0, 1.1, 0.0))};
    light.intensity = Rgb(0.001);
    return light;
}

/// Rays near a ground sphere and a ball on it, and the camera and a light at any distance.
StressCase ground_lights(StressRandom& random)
{
    const double radius = random.power(1e2, 1e7);
    StressCase result;
    result.scene.objects = {sphere_object({0.0, -radius, 0.0}, radius),
                            sphere_object({0.0, 1.0, 3.0}, 1.0)};
    result.scene.camera.position = {0.0, random.power(1.0, 1e6), 0.0};
    result.scene.lights = {far_light(random)};
    result.ray = [=](StressRandom& r) { return to_ground(r, radius, r.power(0.1, 100.0)); };
    return result;
}

/// Note 001's spheres with one more light.
StressCase known_lights()
{
    StressCase result =
        known_case({sphere_object({0, -1, 3}, 1), sphere_object({-2, 1, 3}, 1),
                    sphere_object({2, 1, 3}, 1), sphere_object({0, -5001, 0}, 5000)},
                   {});
    result.scene.lights = {
        Light{.type = LightType::point, .intensity = Rgb(0.001), .vector = {0, 300, 0}}};
    result.ray = [](StressRandom& random) {
        const double x = random.between(-0.5, 0.5);
        const double y = random.between(-0.5, 0.5);
        return StressRay{Vec3(0.0), Vec3(x, y, 1.0), 0.0, no_end};
    };
    return result;
}

/// A few objects around the origin, seen through a lens from ten thousand units away.
StressCase telephoto(StressRandom& random)
{
    const Vec3 eye = 1e4 * random.unit();
    StressCase result;
    std::vector<Vec3> centers;
    for (int i = 0; i < 4; ++i) {
        centers.push_back(random.box(2.0));
        result.scene.objects.push_back(sphere_object(centers.back(), random.between(0.3, 0.8)));
    }
    for (const QuadricKind kind : {QuadricKind::ellipsoid, QuadricKind::paraboloid}) {
        Object object{.surface = packtrace::quadric(kind)};
        centers.push_back(random.box(2.0));
        object.transform = any_placement(random, any_stretch(random, 0.3), centers.back());
        result.scene.objects.push_back(object);
    }
    result.scene.camera.position = eye;
    result.ray = [=](StressRandom& r) {
        const Vec3& center = r.pick(centers);
        return ray_towards(eye, center + r.between(0.0, 1.2) * r.unit());
    };
    return result;
}

/// Past the silhouette of a sphere or an ellipsoid by very little, from near and far.
StressCase silhouette(StressRandom& random)
{
    const Vec3 stretch = random.below(2) == 0 ? Vec3(1.0) : any_stretch(random, 0.1);
    const Mat4 transform = any_placement(random, stretch, random.box(2.0));
    const double far = random.power(2.0, 1e4);
    const auto own_ray = [far](StressRandom& r) {
        const Vec3 way = r.unit();
        const double miss = 1.0 + r.sign() * r.power(3e-8, 1e-3);
        return ray_towards(-way * far, miss * across(r, way));
    };
    if (stretch != Vec3(1.0))
        return placed(packtrace::quadric(QuadricKind::ellipsoid), transform, own_ray);
    const Vec3 center(transform[3]);
    const double radius = random.between(0.2, 2.0);
    return case_of({sphere_object(center, radius)}, [=](StressRandom& r) {
        const StressRay own = own_ray(r);
        return StressRay{center + radius * own.org, glm::normalize(own.dir), 0.0, no_end};
    });
}

StressCase known_silhouette()
{
    return known_case({sphere_object({-1.4, 0.6, 0}, 0.6)},
                      {{3000, 2500, -9205},
                       {-0.30013808608055115, -0.24990345537662506, 0.9205788373947144},
                       0.0,
                       no_end});
}

/// Nearly along the axis: the second hit is as far away as 1e18.
StressCase far_paraboloid(StressRandom& random)
{
    const Mat4 transform = sometimes_placed(random, 0.5, 2.0);
    return placed(packtrace::quadric(QuadricKind::paraboloid), transform, [](StressRandom& r) {
        const Vec3 org = r.box(1.0) + Vec3(0.0, 0.0, 2.0);
        const Vec3 off = r.power(1e-9, 1e-5) * across(r, {0.0, 0.0, 1.0});
        return ray_towards(org, org + Vec3(0.0, 0.0, 1.0) + off);
    });
}

}  // namespace

std::vector<StressFamily> far_families()
{
    const Quadric ellipsoid = packtrace::quadric(QuadricKind::ellipsoid);
    return {
        {"tiny-spheres",
         "spheres so small and far that both hits are one float",
         tiny_sphere,
         {known_tiny_sphere}},
        {"thin-slabs", "two planes 1e-7 to 1e-2 apart, from 10 to 1e4 away",
         [](StressRandom& r) { return thin(r, slab(), 1e-7, 1e-2); }},
        {"thin-pancakes",
         "ellipsoids of 1 by 1 by 1e-6 to 1e-3, from 10 to 1e4 away",
         [=](StressRandom& r) { return thin(r, ellipsoid, 1e-6, 1e-3); },
         {known_pancake}},
        {"slab-inside", "between two planes, to t = 1e6", inside_slab},
        {"ground-eyes", "ground spheres of 1e2 to 1e7 from heights of 1 to 1e6", ground_eyes},
        {"ground-lights",
         "ground spheres of 1e2 to 1e7 with a light 1 to 1e6 away",
         ground_lights,
         {known_lights}},
        {"telephoto", "spheres and quadrics from an eye 1e4 away", telephoto},
        {"silhouettes",
         "3e-8 to 1e-3 past the edges of spheres and ellipsoids, from up to 1e4",
         silhouette,
         {known_silhouette}},
        {"paraboloid-far", "along a paraboloid to t = 1e15 and more", far_paraboloid},
    };
}

}  // namespace packtrace::lab
