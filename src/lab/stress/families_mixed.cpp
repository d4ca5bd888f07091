#include "lab/stress/placed_quadric.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

// Directions and ray intervals of any size, and scenes of twins, nested objects and crowds.
namespace packtrace::lab {
namespace {

/// A quadric of any kind, and a source of points on its surface for rays to aim at.
struct AnyQuadric {
    Object object;
    std::function<Vec3(StressRandom&)> point;
};

AnyQuadric any_quadric(StressRandom& random, double size, const Vec3& to)
{
    const QuadricKind kind = random.pick(every_kind);
    AnyQuadric result;
    Quadric quadric = packtrace::quadric(kind);
    const int clipping = random.below(3);
    if (clipping > 0 && kind != QuadricKind::saddle) {
        quadric.z_range = ZRange{-0.75, 1.25};
        quadric.capped = clipping == 2;
    }
    result.object.surface = quadric;
    result.object.transform = any_placement(random, size * any_stretch(random, 0.3), to);
    result.point = [kind, transform = result.object.transform](StressRandom& r) {
        return to_world(transform, own_surface_point(r, kind));
    };
    return result;
}

/// A sphere or a quadric with rays at it and past it, which `change` alters.
StressCase one_object(StressRandom& random, double size, const Vec3& to,
                      const std::function<void(StressRandom&, StressRay&)>& change)
{
    StressCase result;
    std::function<Vec3(StressRandom&)> point;
    if (random.below(2) == 0) {
        result.scene.objects = {sphere_object(to, size)};
        point = [=](StressRandom& r) { return to + size * r.between(0.9, 1.05) * r.unit(); };
    } else {
        AnyQuadric quadric = any_quadric(random, size, to);
        result.scene.objects = {quadric.object};
        point = quadric.point;
    }
    result.ray = [=](StressRandom& r) {
        const Vec3 org = to + size * r.between(0.2, 8.0) * r.unit();
        StressRay ray = ray_towards(org, point(r));
        change(r, ray);
        return ray;
    };
    return result;
}

/// Directions of any length; t counts in their lengths.
StressCase lengths(StressRandom& random)
{
    return one_object(random, random.power(0.1, 10.0), random.box(3.0),
                      [](StressRandom& r, StressRay& ray) {
                          ray.dir = r.power(1e-6, 1e6) * glm::normalize(ray.dir);
                      });
}

/// Rays aim at t = 1. Their intervals begin or end, or both, next to it.
StressCase range_ends(StressRandom& random)
{
    return one_object(random, random.between(0.5, 2.0), random.box(3.0),
                      [](StressRandom& r, StressRay& ray) {
                          const int which = r.below(3);
                          const double end = 1.0 + r.sign() * r.power(1e-9, 1e-2);
                          (which == 0 ? ray.t_max : ray.t_min) = end;
                          if (which == 2)
                              ray.t_max = end * (1.0 + r.power(1e-7, 1e-2));
                      });
}

/// Rays with components that are 0 or very small.
StressCase vanishing(StressRandom& random)
{
    return one_object(random, random.between(0.5, 2.0), Vec3(0.0),
                      [](StressRandom& r, StressRay& ray) {
                          for (int axis = 0; axis < 3; ++axis) {
                              if (r.below(3) == 0)
                                  ray.dir[axis] = r.below(2) == 0 ? 0.0 : r.power(1e-44, 1e-30);
                              if (r.below(3) == 0)
                                  ray.org[axis] = r.below(2) == 0 ? 0.0 : r.power(1e-44, 1e-30);
                          }
                          if (glm::length(ray.dir) < 1e-3)
                              ray.dir[r.below(3)] = r.sign();
                      });
}

/// Small objects far from the origin, with rays next to them.
StressCase far_details(StressRandom& random)
{
    return one_object(random, random.power(3e-2, 10.0), 1e6 * random.unit(),
                      [](StressRandom&, StressRay&) {});
}

/// Quadrics stretched by very different factors along their axes.
StressCase flat_axes(StressRandom& random)
{
    const QuadricKind kind = random.pick(every_kind);
    const Mat4 transform = any_placement(
        random, {1.0, random.power(1e-5, 1.0), random.power(1.0, 1e3)}, random.box(3.0));
    return placed(packtrace::quadric(kind), transform, [kind](StressRandom& r) {
        const Vec3 aim = own_surface_point(r, kind);
        return ray_towards(aim + r.between(0.5, 5.0) * r.unit(), aim);
    });
}

/// The same object three times.
StressCase twins(StressRandom& random)
{
    StressCase result = one_object(random, random.between(0.5, 2.0), random.box(3.0),
                                   [](StressRandom&, StressRay&) {});
    const Object first = result.scene.objects[0];
    result.scene.objects = {first, first, first};
    return result;
}

/// Nested spheres that touch at one point, and rays at it from inside and outside.
StressCase nested(StressRandom& random)
{
    const Vec3 point = random.box(3.0);
    const Vec3 way = random.unit();
    StressCase result;
    double radius = random.between(0.5, 1.0);
    for (int i = 0; i < 4; ++i, radius *= random.between(1.001, 2.0))
        result.scene.objects.push_back(sphere_object(point + radius * way, radius));
    result.ray = [=](StressRandom& r) {
        const Vec3 aim = point + r.power(1e-6, 1.0) * r.unit();
        return ray_towards(aim + r.between(0.5, 8.0) * r.unit(), aim);
    };
    return result;
}

/// Quadrics that intersect each other, among spheres and planes: enough for a BVH.
StressCase crowd(StressRandom& random)
{
    StressCase result;
    std::vector<std::function<Vec3(StressRandom&)>> points;
    for (int i = 0; i < 24; ++i) {
        AnyQuadric quadric = any_quadric(random, random.power(0.1, 2.0), random.box(5.0));
        result.scene.objects.push_back(quadric.object);
        points.push_back(quadric.point);
        const Vec3 center = random.box(5.0);
        const double radius = random.power(0.03, 2.0);
        result.scene.objects.push_back(sphere_object(center, radius));
        points.emplace_back(
            [=](StressRandom& r) { return center + r.between(0.9, 1.02) * radius * r.unit(); });
    }
    for (int i = 0; i < 3; ++i)
        result.scene.objects.push_back(plane_object(random.box(6.0), random.unit()));
    result.ray = [points](StressRandom& r) {
        const Vec3 aim = r.pick(points)(r);
        return ray_towards(aim + r.between(0.5, 12.0) * r.unit(), aim);
    };
    return result;
}

/// Spheres and quadrics of sizes from 1e-4 to 1e4, which hide each other.
StressCase all_sizes(StressRandom& random)
{
    StressCase result;
    std::vector<std::function<Vec3(StressRandom&)>> points;
    for (int power = -4; power <= 4; ++power) {
        const double size = std::pow(10.0, power);
        AnyQuadric quadric = any_quadric(random, size, 2.0 * size * random.unit());
        result.scene.objects.push_back(quadric.object);
        points.push_back(quadric.point);
        result.scene.objects.push_back(sphere_object(3.0 * size * random.unit(), size));
    }
    result.ray = [points](StressRandom& r) {
        const int which = r.below(static_cast<int>(points.size()));
        const Vec3 aim = points[static_cast<std::size_t>(which)](r);
        return ray_towards(aim + std::pow(10.0, which - 4) * r.between(0.5, 5.0) * r.unit(), aim);
    };
    return result;
}

}  // namespace

std::vector<StressFamily> mixed_families()
{
    return {
        {"lengths", "directions of lengths 1e-6 to 1e6", lengths},
        {"range-ends", "t_min and t_max within 1e-9 to 1e-2 of a surface", range_ends},
        {"vanishing", "rays with components that are 0, or next to it", vanishing},
        {"far-details", "things of 0.03 to 10 at 1e6 from the origin", far_details},
        {"flat-axes", "half axes 1e-5 to 1e3 in one quadric", flat_axes},
        {"twins", "the same object three times", twins},
        {"nested", "spheres in each other that touch at one point", nested},
        {"crowd", "51 objects of every kind that cross each other", crowd},
        {"all-sizes", "spheres and quadrics of 1e-4 to 1e4 in one another", all_sizes},
    };
}

}  // namespace packtrace::lab
