#include "lab/stress/placed_quadric.hpp"

#include <glm/geometric.hpp>

#include <cmath>

// Edges: of crossing planes, of capped bodies; and rays along a cone's sides.
namespace packtrace::lab {
namespace {

Quadric crossing(const Vec3& square)
{
    return {.coefficients = {square.x, square.y, square.z, 0, 0, 0, 0, 0, 0, 0}};
}

/// The planes x = ±z in a random placement, and rays past their edge by 1e-12 to 1e-3, or through
/// it.
StressCase crossing_planes(StressRandom& random)
{
    const Mat4 transform = sometimes_placed(random, 0.3, 2.0);
    return placed(crossing({1.0, 0.0, -1.0}), transform, [](StressRandom& r) {
        const Vec3 edge(0.0, r.between(-2.0, 2.0), 0.0);
        const double off = r.below(4) == 0 ? 0.0 : r.power(1e-12, 1e-3);
        Vec3 org = r.between(1.0, 6.0) * r.unit();
        if (r.below(4) == 0)
            org[r.below(2) * 2] = 0.0;
        return ray_towards(org, edge + off * r.unit());
    });
}

StressCase known_edge()
{
    Object planes{.surface = crossing({1.0, 0.0, -1.0})};
    return known_case({planes}, {{0, 0, -5}, {0, 0.04, 0.2}, 0.0, no_end});
}

Quadric capped(QuadricKind kind, double low, double high)
{
    Quadric quadric;
    if (kind == QuadricKind::general)
        quadric.coefficients = {1.0, 1.5, 0.8, 0.2, 0.1, -0.15, 0.05, 0.0, 0.1, -1.0};
    else
        quadric = packtrace::quadric(kind);
    quadric.z_range = ZRange{low, high};
    quadric.capped = true;
    return quadric;
}

/// A quadric of any kind that is a closed body with caps.
Quadric any_capped(StressRandom& random)
{
    switch (random.below(8)) {
        case 0:
            return capped(QuadricKind::ellipsoid, -0.6, 0.7);
        case 1:
            return capped(QuadricKind::cylinder, -1.0, 1.0);
        case 2:
            return capped(QuadricKind::cone, 0.25, 1.25);
        case 3:
            return capped(QuadricKind::cone, -1.0, 1.0);
        case 4:
            return capped(QuadricKind::paraboloid, 0.25, 1.25);
        case 5:
            return capped(QuadricKind::hyperboloid, -0.75, 1.25);
        case 6:
            return capped(QuadricKind::hyperboloid2, 1.1, 2.0);
        default:
            return capped(QuadricKind::general, -0.5, 0.6);
    }
}

/// The point of a quadric's side at height z and an angle around the z axis.
Vec3 side_point(const Quadric& quadric, double z, double angle)
{
    const auto& k = quadric.coefficients;
    const double x = std::cos(angle);
    const double y = std::sin(angle);
    const double a = k[0] * x * x + k[1] * y * y + k[3] * x * y;
    const double b = (k[4] * x + k[5] * y) * z + k[6] * x + k[7] * y;
    const double c = k[2] * z * z + k[8] * z + k[9];
    const double radius = (-b + std::sqrt(std::max(0.0, b * b - 4.0 * a * c))) / (2.0 * a);
    return {radius * x, radius * y, z};
}

Vec3 rim_point(StressRandom& random, const Quadric& quadric)
{
    const ZRange& range = *quadric.z_range;
    return side_point(quadric, random.below(2) == 0 ? range.low : range.high, random.angle());
}

Vec3 inside_point(StressRandom& random, const Quadric& quadric)
{
    const ZRange& range = *quadric.z_range;
    const double z = range.low + (range.high - range.low) * random.between(0.02, 0.98);
    const Vec3 side = side_point(quadric, z, random.angle());
    const double share = 0.98 * std::sqrt(random.between(0.0, 1.0));
    return {share * side.x, share * side.y, z};
}

StressCase rim_from_outside(StressRandom& random)
{
    const Quadric quadric = any_capped(random);
    return placed(quadric, sometimes_placed(random, 0.3, 2.0), [=](StressRandom& r) {
        const Vec3 rim = rim_point(r, quadric);
        const double off = r.below(8) == 0 ? 0.0 : r.power(1e-9, 1e-2);
        return ray_towards(r.between(3.0, 10.0) * r.unit(), rim + off * r.unit());
    });
}

/// Rays from inside a capped quadric; half of them aim at its rims.
StressCase closed_body(StressRandom& random)
{
    const Quadric quadric = any_capped(random);
    return placed(quadric, sometimes_placed(random, 0.3, 2.0), [=](StressRandom& r) {
        const Vec3 org = inside_point(r, quadric);
        if (r.below(2) == 0)
            return ray_towards(org, org + r.unit());
        const double off = r.below(8) == 0 ? 0.0 : r.power(1e-9, 1e-3);
        return ray_towards(org, rim_point(r, quadric) + off * r.unit());
    });
}

StressCase known_rim()
{
    Object cylinder{.surface = capped(QuadricKind::cylinder, -1.0, 1.0)};
    return known_case({cylinder}, {{0.5, -0.10000000149011612, -0.30000001192092896},
                                   {0.5, 0.10000000149011612, -0.699999988079071},
                                   0.0,
                                   no_end});
}

/// A ray origin well off the cone x² + y² = z² and off its tangent plane that contains `way`.
Vec3 off_cone(StressRandom& random, const Vec3& way)
{
    for (;;) {
        Vec3 org;
        for (int axis = 0; axis < 3; ++axis)
            org[axis] = (random.below(129) - 64) / 16.0;
        const double value = org.x * org.x + org.y * org.y - org.z * org.z;
        const double slope = org.x * way.x + org.y * way.y - org.z * way.z;
        if (std::abs(value) > 0.25 && std::abs(slope) > 0.25)
            return org;
    }
}

/// Rays exactly parallel to a cone's side, with whole numbers or two equal numbers as directions: a
/// is exactly 0, though x² and y² - z² may be rounded.
StressCase cone_generators(StressRandom&)
{
    StressCase result;
    Object cone{.surface = packtrace::quadric(QuadricKind::cone)};
    result.scene.objects = {cone};
    result.ray = [](StressRandom& r) {
        static const Vec3 ways[] = {{0, 1, 1}, {1, 0, 1}, {3, 4, 5}, {5, 12, 13}, {8, 15, 17}};
        const int which = r.below(5);
        Vec3 way = ways[which];
        for (int axis = 0; axis < 3; ++axis)
            way[axis] *= r.sign();
        if (which < 2)
            way *= r.between(0.5, 2.0);
        StressRay ray{off_cone(r, way), way, 0.0, no_end};
        ray.exact = true;
        return ray;
    };
    return result;
}

}  // namespace

std::vector<StressFamily> edge_families()
{
    return {
        {"crossing-planes",
         "at the edge of two crossing planes, past it by 0 to 1e-3",
         crossing_planes,
         {known_edge}},
        {.name = "rims-outside",
         .what = "at the rims of every capped kind, from outside",
         .make = rim_from_outside,
         .closed = true},
        {.name = "closed-bodies",
         .what = "out of every capped kind, half of the rays at the rims",
         .make = closed_body,
         .known = {known_rim},
         .closed = true},
        {"cone-generators", "parallel to the sides of a cone to the last digit", cone_generators},
    };
}

}  // namespace packtrace::lab
