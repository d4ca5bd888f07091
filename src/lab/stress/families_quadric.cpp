#include "lab/stress/placed_quadric.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <utility>

namespace packtrace::lab {
namespace {

using Kinds = std::vector<QuadricKind>;

/// Rays from a few units away in the world, at the surface and past it.
StressCase shot_at(StressRandom& random, const Kinds& kinds, const Mat4& transform)
{
    const QuadricKind kind = random.pick(kinds);
    StressCase result = placed(packtrace::quadric(kind), transform, {});
    result.ray = [=](StressRandom& r) {
        const Vec3 aim = own_surface_point(r, kind) * r.between(0.7, 1.3);
        const Vec3 org = Vec3(transform[3]) + r.between(2.0, 10.0) * r.unit();
        StressRay ray = ray_towards(org, to_world(transform, aim));
        ray.dir = glm::normalize(ray.dir);
        return ray;
    };
    return result;
}

/// Rays of own space with directions near `way`, off by 0 or by `least` to `most`, near the middle.
StressCase along(StressRandom& random, QuadricKind kind, std::function<Vec3(StressRandom&)> way,
                 double least, double most)
{
    const Mat4 transform = any_placement(random, any_stretch(random, 0.5), random.box(3.0));
    return placed(packtrace::quadric(kind), transform, [=, way = std::move(way)](StressRandom& r) {
        const Vec3 d = way(r);
        const double off = r.below(8) == 0 ? 0.0 : r.power(least, most);
        const Vec3 target = r.box(2.0);
        return ray_towards(target - 4.0 * d, target + off * r.unit() * 4.0);
    });
}

Vec3 axis(StressRandom& random)
{
    return {0.0, 0.0, random.sign()};
}

Vec3 asymptote(StressRandom& random)
{
    const double turn = random.angle();
    return {std::cos(turn), std::sin(turn), random.sign()};
}

StressCase at_apex(StressRandom& random)
{
    const Mat4 transform = any_placement(random, any_stretch(random, 0.5), random.box(3.0));
    return placed(packtrace::quadric(QuadricKind::cone), transform, [](StressRandom& r) {
        return ray_towards(r.between(1.0, 5.0) * r.unit(), r.power(1e-7, 1e-2) * r.unit());
    });
}

enum class Ends { open, capped };

/// Of every kind but the saddle.
StressCase clipped(StressRandom& random, Ends ends)
{
    const QuadricKind kind = every_kind[static_cast<std::size_t>(random.below(6))];
    Quadric quadric = packtrace::quadric(kind);
    quadric.z_range = ZRange{-0.75, 1.25};
    quadric.capped = ends == Ends::capped;
    const Mat4 transform = any_placement(random, any_stretch(random, 0.5), random.box(3.0));
    return placed(quadric, transform, [](StressRandom& r) {
        return ray_towards(r.between(2.0, 6.0) * r.unit(), r.box(1.5));
    });
}

StressCase general(StressRandom& random)
{
    Quadric quadric;
    for (std::size_t i = 0; i < 9; ++i)
        quadric.coefficients[i] = static_cast<float>(random.between(-1.0, 1.0));
    // Negative at the origin and positive far along x, so that there is a surface.
    quadric.coefficients[0] = static_cast<float>(random.between(0.1, 1.0));
    quadric.coefficients[9] = -1.0;
    return placed(quadric, Mat4(1.0), [](StressRandom& r) {
        return ray_towards(r.between(2.0, 6.0) * r.unit(), r.box(1.5));
    });
}

/// Half axes 1, 1/100 and 1/10 000, turned at random.
StressCase ill_conditioned(StressRandom& random)
{
    Mat4 transform = any_placement(random, {1.0, 1e-2, 1e-4}, random.box(3.0));
    return shot_at(random, every_kind, transform);
}

/// Sheared and mirrored.
StressCase mirrored(StressRandom& random)
{
    Vec3 stretch = any_stretch(random, 0.1);
    stretch[random.below(3)] *= -1.0;
    Mat4 transform = any_placement(random, stretch, random.box(3.0));
    Mat4 shear(1.0);
    shear[1][0] = random.between(-2.0, 2.0);
    shear[2][1] = random.between(-2.0, 2.0);
    return shot_at(random, every_kind, transform * shear);
}

/// A straight line on a saddle or a hyperboloid.
struct StraightLine {
    Vec3 point;
    Vec3 way;
};

StraightLine straight_line(StressRandom& random, QuadricKind kind)
{
    const double other = random.sign();
    if (kind == QuadricKind::saddle) {
        const double x = random.between(-1.5, 1.5);
        const double y = random.between(-1.5, 1.5);
        return {{x, y, x * x - y * y}, {1.0, other, 2.0 * (x - other * y)}};
    }
    const double turn = random.angle();
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return {{c, s, 0.0}, {-s, c, other}};
}

/// Rays nearly along such lines: a, b and c are nearly 0.
StressCase along_straight_lines(StressRandom& random)
{
    const QuadricKind kind = random.below(2) == 0 ? QuadricKind::saddle : QuadricKind::hyperboloid;
    const Mat4 transform = sometimes_placed(random, 0.5, 3.0);
    return placed(packtrace::quadric(kind), transform, [=](StressRandom& r) {
        const StraightLine line = straight_line(r, kind);
        const double off = r.below(4) == 0 ? 0.0 : r.power(1e-9, 1e-4);
        const Vec3 org = line.point + r.between(-3.0, 3.0) * line.way + off * r.unit();
        const Vec3 way = r.between(0.5, 3.0) * line.way + off * r.unit();
        return ray_towards(org, org + way);
    });
}

StressFamily shot_family(const char* name, const char* what, const Kinds& kinds,
                         const Vec3& stretch, double far)
{
    return {name, what, [=](StressRandom& random) {
                const Vec3 to = far > 0.0 ? far * random.unit() : random.box(3.0);
                return shot_at(random, kinds, any_placement(random, stretch, to));
            }};
}

StressFamily along_family(const char* name, const char* what, QuadricKind kind,
                          Vec3 (*way)(StressRandom&), double least)
{
    return {name, what,
            [=](StressRandom& random) { return along(random, kind, way, least, 1e-2); }};
}

}  // namespace

std::vector<StressFamily> quadric_families()
{
    const Kinds ellipsoid = {QuadricKind::ellipsoid};
    return {
        shot_family("quadrics", "every kind, mildly stretched", every_kind, {1.0, 0.7, 0.5}, 0.0),
        {"clipped", "clipped quadrics", [](StressRandom& r) { return clipped(r, Ends::open); }},
        {"capped", "clipped and capped quadrics",
         [](StressRandom& r) { return clipped(r, Ends::capped); }},
        {"general", "general quadrics", general},
        shot_family("needle", "ellipsoids of 1 by 1/1000 by 1/1000", ellipsoid, {1e-3, 1e-3, 1.0},
                    0.0),
        shot_family("pancake", "ellipsoids of 1 by 1 by 1/1000", ellipsoid, {1.0, 1.0, 1e-3}, 0.0),
        {"cone-apex", "past a cone's apex by 1e-2 to 1e-7", at_apex},
        along_family("asymptote", "along the asymptotes of hyperboloids", QuadricKind::hyperboloid,
                     asymptote, 1e-7),
        along_family("cone-side", "along the sides of cones", QuadricKind::cone, asymptote, 1e-7),
        along_family("paraboloid-axis", "along the axis of paraboloids", QuadricKind::paraboloid,
                     axis, 1e-8),
        along_family("cylinder-axis", "along the axis of cylinders", QuadricKind::cylinder, axis,
                     1e-7),
        {"straight-lines", "along the straight lines of saddles and hyperboloids, off by 0 to 1e-4",
         along_straight_lines},
        {"cond-1e4", "half axes from 1 to 1e-4", ill_conditioned},
        {"mirrored", "sheared and mirrored", mirrored},
        shot_family("far-quadric", "every kind, with its rays at 1e5 from the origin", every_kind,
                    {1.0, 0.7, 0.5}, 1e5),
    };
}

}  // namespace packtrace::lab
