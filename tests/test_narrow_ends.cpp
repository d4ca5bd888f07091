// Rays from a long cone's wall that run nearly along it, to its narrow open end. In terms of the
// cone's equation, rounding moves their start off the wall by more than the narrow end's width.
#include "catch.hpp"
#include "packet_ways.hpp"
#include "scenes.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

namespace packtrace::test {
namespace {

using Place = std::array<long double, 3>;

constexpr double narrow_end = 0.25;

std::string open_cone(double wide_end)
{
    return "cone { z_range = (" + std::to_string(narrow_end) + ", " + std::to_string(wide_end) +
           ") } ";
}

/// The bilinear form of the unit cone.
long double cone_product(const Place& a, const Place& b)
{
    return a[0] * b[0] + a[1] * b[1] - a[2] * b[2];
}

/// The point of the unit cone close to p.
Place next_on_cone(const Place& p)
{
    const long double across = std::hypot(p[0], p[1]);
    const long double middle = (across + p[2]) / 2;
    return {p[0] * (middle / across), p[1] * (middle / across), middle};
}

/// A ray that starts on the wall.
template <class Real>
struct WallRay {
    std::array<Real, 3> point, dir;
    bool outside = false;
    std::optional<long double> t;  ///< the true t of its next hit with the wall

    [[nodiscard]] Place start() const
    {
        return next_on_cone({point[0], point[1], point[2]});
    }
};

/// The hit of a line from a point of the cone with the cone between its ends. t = 0 if rounding
/// decides, or if the hit is far from the narrow end.
std::optional<long double> wall_crossing(const Place& start, const Place& way, double wide_end)
{
    const long double bend = cone_product(way, way);
    const long double slope = cone_product(start, way);
    const long double t = -2 * slope / bend;
    if (!(t > 0))
        return std::nullopt;
    const long double z = start[2] + t * way[2];
    if (std::abs(z - narrow_end) < 1e-5 || z > start[2] / 8)
        return 0.0L;
    return z > narrow_end && z < wide_end ? std::optional(t) : std::nullopt;
}

template <class Real>
std::array<Real, 3> point_of_wall(SceneRandom& random, double wide_end)
{
    const double z = random.between(wide_end / 4, wide_end);
    const double angle = random.between(0.0, 6.2831853);
    return {static_cast<Real>(z * std::cos(angle)), static_cast<Real>(z * std::sin(angle)),
            static_cast<Real>(z)};
}

/// A ray from a point of the wall to a point in or below the narrow end. No value if rounding
/// decides or the ray hits the cone far from there.
template <class Real>
std::optional<WallRay<Real>> ray_to_narrow_end(SceneRandom& random, double wide_end)
{
    WallRay<Real> ray;
    ray.point = point_of_wall<Real>(random, wide_end);
    const Place target{random.between(-0.3, 0.3), random.between(-0.3, 0.3),
                       random.between(-0.3, 0.4)};
    Place way;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ray.dir[axis] = static_cast<Real>((target[axis] - ray.point[axis]) / wide_end);
        way[axis] = ray.dir[axis];
    }
    const Place start = ray.start();
    const long double slope = cone_product(start, way);
    ray.outside = slope > 0;
    ray.t = wall_crossing(start, way, wide_end);
    // On its way the ray is no further from the wall than rounding moves its start.
    const bool along = std::abs(slope * slope / cone_product(way, way)) <
                       64 * std::numeric_limits<Real>::epsilon() * start[2] * start[2];
    return along || ray.t == 0.0L ? std::nullopt : std::optional(ray);
}

template <class Real>
SurfaceHit<Real> hit_again(const RayScene<Real>& scene, const WallRay<Real>& ray)
{
    const Real zero = 0;
    const Real far = 1e9;
    const std::int32_t side = ray.outside ? 0 : ~0;
    SurfaceHit<Real> hit;
    const auto& [p, d] = std::tie(ray.point, ray.dir);
    scene.closest_hits({&p[0], &p[1], &p[2], &d[0], &d[1], &d[2], &zero, &far, 1},
                       {{&p[0], &p[1], &p[2]}, &side}, {&hit.t, &hit.object});
    return hit;
}

/// The number of rays that hit the wall again.
template <class Real>
int check_narrow_ends(const RenderOptions& options, double wide_end)
{
    const RayScene<Real> scene(parse_scene(open_cone(wide_end), "cone", {}), options);
    SceneRandom random(11);
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto ray = ray_to_narrow_end<Real>(random, wide_end);
        if (!ray)
            continue;
        const SurfaceHit<Real> hit = hit_again(scene, *ray);
        CAPTURE(options.isa, sizeof(Real), wide_end, i, ray->outside, ray->t.value_or(-1), hit.t);
        REQUIRE((hit.object == 0) == ray->t.has_value());
        if (!ray->t)
            continue;
        ++hits;
        REQUIRE(std::abs(hit.t - *ray->t) <= 1e-6L * *ray->t);
    }
    return hits;
}

/// A ray from the point (300, 400, 500) of the cone to a point near its apex, where the cone is
/// cut.
struct ApexRay {
    std::array<double, 3> dir;
    double t;
};

constexpr Vec3 light{0.1875, 0.0, 0.125};

/// Whether the light below the narrow end reaches a point of the wall; no value if rounding
/// decides.
template <class Real>
std::optional<bool> reached(const std::array<Real, 3>& point, double wide_end)
{
    const Place start = next_on_cone({point[0], point[1], point[2]});
    const Place way{light.x - start[0], light.y - start[1], light.z - start[2]};
    const auto t = wall_crossing(start, way, wide_end);
    if (t == 0.0L)
        return std::nullopt;
    return !t || *t > 1;
}

/// The number of points that the light reaches.
template <class Real>
int check_lit(const RenderOptions& options, double wide_end)
{
    const std::string lamp = "light { type = point  intensity = 1  position = (0.1875, 0, 0.125) }";
    const RayScene<Real> scene(parse_scene(open_cone(wide_end) + lamp, "cone", {}), options);
    SceneRandom random(12);
    int count = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto point = point_of_wall<Real>(random, wide_end);
        const auto expected = reached(point, wide_end);
        if (!expected)
            continue;
        const std::int32_t side = 0;
        std::uint8_t lit = 7;
        scene.lit({{&point[0], &point[1], &point[2]}, &side, 1}, 0, &lit);
        CAPTURE(options.isa, sizeof(Real), wide_end, i);
        REQUIRE((lit != 0) == *expected);
        count += *expected;
    }
    return count;
}

}  // namespace

TEST_CASE("rays along a long cone's wall hit it again only before its narrow end", "[narrow_ends]")
{
    for (const RenderOptions& options : packet_ways())
        for (const double wide_end : {10.0, 100.0, 1000.0, 10000.0}) {
            CHECK(check_narrow_ends<float>(options, wide_end) > 100);
            CHECK(check_narrow_ends<double>(options, wide_end) > 100);
        }
}

TEST_CASE("a ray that barely passes a cone's apex is placed as exactly as other rays",
          "[narrow_ends]")
{
    const ApexRay rays[] = {
        {{-300.00004325586519, -400.00001762976177, -499.99984289859248}, 1.0000001141160513},
        {{-300.00017118951558, -400.0000615378018, -500.00005054908991}, 0.9999996988256471}};
    const Scene cone = parse_scene("cone { z_range = (0.0001, 1000) }", "cone", {});
    for (const RenderOptions& options : packet_ways()) {
        const RayScene<double> scene(cone, options);
        for (const ApexRay& ray : rays) {
            WallRay<double> from;
            from.point = {300, 400, 500};
            from.dir = ray.dir;
            const SurfaceHit<double> hit = hit_again(scene, from);
            CAPTURE(options.isa);
            CHECK(hit.object == 0);
            CHECK(std::abs(hit.t - ray.t) <= 1e-11);
        }
    }
}

TEST_CASE("a lamp below a long cone's narrow end reaches points that the wall does not occlude",
          "[narrow_ends]")
{
    for (const RenderOptions& options : packet_ways())
        for (const double wide_end : {10.0, 100.0, 1000.0}) {
            const int single = check_lit<float>(options, wide_end);
            CHECK(single > 100);
            CHECK(single < 900);
            CHECK(check_lit<double>(options, wide_end) > 100);
        }
}

}  // namespace packtrace::test
