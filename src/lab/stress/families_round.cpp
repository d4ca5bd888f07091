#include "lab/stress/stress_family.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <utility>

// Spheres and planes.
namespace packtrace::lab {
namespace {

using Aim = std::function<StressRay(StressRandom&, const Vec3& center, double radius)>;

/// One sphere, and rays aimed at it.
StressCase one_sphere(const Vec3& center, double radius, Aim aim)
{
    return case_of(
        {sphere_object(center, radius)},
        [=, aim = std::move(aim)](StressRandom& random) { return aim(random, center, radius); });
}

/// From a few radii away, at the ball and a little past it.
StressRay from_outside(StressRandom& random, const Vec3& center, double radius)
{
    const Vec3 org = center + random.unit() * (radius * random.between(1.1, 10.0));
    return ray_towards(org, center + 1.3 * radius * random.between(0.0, 1.0) * random.unit());
}

/// Past the ball's silhouette by small amounts of any size, on both sides.
StressRay along_edge(StressRandom& random, const Vec3& center, double radius)
{
    const Vec3 way = random.unit();
    const double miss = radius * (1.0 + random.sign() * random.power(1e-8, 1e-2));
    const Vec3 org = center - way * (radius * random.between(2.0, 10.0));
    return ray_towards(org, center + miss * across(random, way));
}

StressRay from_surface(StressRandom& random, const Vec3& center, double radius)
{
    const Vec3 org = center + radius * random.unit();
    return ray_towards(org, org + random.unit());
}

StressRay from_inside(StressRandom& random, const Vec3& center, double radius)
{
    const Vec3 org = center + random.unit() * (radius * random.between(0.0, 0.999));
    return ray_towards(org, org + random.unit());
}

/// Directions of every length whose square is a float.
StressRay any_length(StressRandom& random, const Vec3& center, double radius)
{
    StressRay ray = from_outside(random, center, radius);
    ray.dir *= random.power(1e-12, 1e12);
    return ray;
}

StressCase ordinary_sphere(StressRandom& random, Aim aim)
{
    return one_sphere(random.box(10.0), random.between(0.2, 2.0), std::move(aim));
}

/// A ball of 1/1000 to 1/100 000 of its distance, seen from near the origin.
StressCase tiny_far_sphere(StressRandom& random)
{
    const double radius = random.between(0.2, 2.0);
    const Vec3 center = random.unit() * (radius * random.power(1e3, 1e5));
    return one_sphere(center, radius, [](StressRandom& r, const Vec3& c, double size) {
        return ray_towards(r.box(10.0), c + 1.3 * size * r.between(0.0, 1.0) * r.unit());
    });
}

StressCase far_sphere(StressRandom& random)
{
    return one_sphere(1e5 * random.unit(), random.between(0.5, 2.0), from_outside);
}

/// From a little above a ground sphere, to points from below the eye to above the horizon.
StressCase ground(StressRandom& random, double radius)
{
    const double top = random.between(-2.0, 0.0);
    StressCase result = one_sphere(
        {0.0, top - radius, 0.0}, radius, [](StressRandom& r, const Vec3& center, double size) {
            const Vec3 over(r.between(-5.0, 5.0), 0.0, r.between(-5.0, 5.0));
            const Vec3 org = over + Vec3(0.0, center.y + size + r.power(0.01, 30.0), 0.0);
            const double turn = r.angle();
            const double fall = r.sign() < 0 ? r.power(1e-4, 1.0) : r.between(-0.01, 0.3);
            return ray_towards(org, org + Vec3(std::cos(turn), -fall, std::sin(turn)));
        });
    result.scene.camera.position = {0.0, top + 1.0, 0.0};
    return result;
}

StressRay unit_from_outside(StressRandom& random, const Vec3& center, double radius)
{
    StressRay ray = from_outside(random, center, radius);
    ray.dir = glm::normalize(ray.dir);
    return ray;
}

/// A scene so large or so small that squares come near the limits of single precision.
StressCase scaled_sphere(StressRandom& random, double scale)
{
    StressCase result =
        one_sphere(scale * random.box(10.0), scale * random.between(0.2, 2.0), unit_from_outside);
    result.scene.camera.position = Vec3(scale);
    return result;
}

/// A plane, and rays that hit it at angles with tangents from `least` to `most`.
StressCase plane_at(StressRandom& random, double far, double least, double most)
{
    const Vec3 normal = random.unit();
    const Vec3 point = far * random.unit();
    return case_of({plane_object(point, normal)}, [=](StressRandom& r) {
        const Vec3 along = across(r, normal);
        const Vec3 org = point + r.sign() * r.between(0.1, 10.0) * normal +
                         10.0 * r.between(-1.0, 1.0) * across(r, normal);
        return ray_towards(org, org + along + r.sign() * r.power(least, most) * normal);
    });
}

StressCase near_plane(StressRandom& random)
{
    const Vec3 normal = random.unit();
    const Vec3 point = random.box(10.0);
    return case_of({plane_object(point, normal)}, [=](StressRandom& r) {
        const Vec3 org = point + r.sign() * r.power(1e-6, 1e-2) * normal +
                         10.0 * r.between(-1.0, 1.0) * across(r, normal);
        return ray_towards(org, org + r.unit());
    });
}

StressFamily sphere_family(const char* name, const char* what, Aim aim)
{
    return {name, what,
            [aim = std::move(aim)](StressRandom& random) { return ordinary_sphere(random, aim); }};
}

}  // namespace

std::vector<StressFamily> sphere_families()
{
    return {
        sphere_family("sphere", "a sphere from a few radii away", from_outside),
        sphere_family("inside", "from inside a sphere", from_inside),
        sphere_family("on-surface", "from a sphere's own surface", from_surface),
        sphere_family("grazing", "past a sphere's edge by 1e-2 to 1e-8 radii", along_edge),
        sphere_family("unnormalised", "directions of length 1e-12 to 1e12", any_length),
        {"ground-5000", "a ground sphere of radius 5000, to the horizon",
         [](StressRandom& random) { return ground(random, 5000.0); }},
        {"ground-1e6", "a ground sphere of radius a million",
         [](StressRandom& random) { return ground(random, 1e6); }},
        {"tiny-far", "a sphere a thousand to a hundred thousand radii away", tiny_far_sphere},
        {"far-sphere", "a sphere and rays at 1e5 from the origin", far_sphere},
        {"scale-1e12", "a sphere where squares near the largest numbers",
         [](StressRandom& random) { return scaled_sphere(random, 1e12); }},
        {"scale-1e-12", "a sphere where squares near the smallest numbers",
         [](StressRandom& random) { return scaled_sphere(random, 1e-12); }},
    };
}

std::vector<StressFamily> plane_families()
{
    return {
        {"plane", "a plane of any slope",
         [](StressRandom& random) { return plane_at(random, 10.0, 0.05, 10.0); }},
        {"plane-grazing", "rays along a plane, sine 1e-6 to 1e-2",
         [](StressRandom& random) { return plane_at(random, 10.0, 1e-6, 1e-2); }},
        {"plane-near", "from 1e-6 to 1e-2 over a plane", near_plane},
        {"plane-far", "a plane and rays at 1e5 from the origin",
         [](StressRandom& random) { return plane_at(random, 1e5, 0.05, 10.0); }},
    };
}

}  // namespace packtrace::lab
