// Rays of whole numbers that touch a body exactly in one point: rounding decides whether they hit
// the body, but not where.
#include "catch.hpp"
#include "packet_ways.hpp"
#include "scenes.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

/// x² wx + y² wy + z² wz = 9, in the scene language.
struct Touched {
    std::string text;
    std::array<std::int64_t, 3> weight;
};

const Touched bodies[] = {
    {"sphere { center = (0, 0, 0)  radius = 3 }", {1, 1, 1}},
    {"ellipsoid { scale = (3, 1, 1) }", {1, 9, 9}},
    {"ellipsoid { scale = (1, 3, 1) }", {9, 1, 9}},
    {"cylinder { scale = (3, 1, 1) }", {1, 9, 0}},
    {"hyperboloid { scale = (3, 1, 1) }", {1, 9, -9}},
    {"hyperboloid2 { scale = (3, 1, 1) }", {-1, -9, 9}},
    {"quadric { coefficients = (1, 9, 9, 0, 0, 0, 0, 0, 0, -9) }", {1, 9, 9}},
};

struct TouchingRay {
    std::array<int, 3> org;
    std::array<int, 3> dir;
    double t;
};

/// Of some thousands of rays, those that touch the body, ahead of or behind their origin.
std::vector<TouchingRay> rays_that_touch(const Touched& body)
{
    SceneRandom random(7);
    std::vector<TouchingRay> rays;
    for (int i = 0; i < 400000; ++i) {
        TouchingRay ray{};
        std::int64_t a = 0;
        std::int64_t b = 0;
        std::int64_t c = -9;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ray.org[axis] = static_cast<int>(std::floor(random.between(-9, 10)));
            ray.dir[axis] = static_cast<int>(std::floor(random.between(-9, 10)));
            const std::int64_t weight = body.weight[axis];
            a += weight * ray.dir[axis] * ray.dir[axis];
            b += weight * ray.org[axis] * ray.dir[axis];
            c += weight * ray.org[axis] * ray.org[axis];
        }
        if (a == 0 || b * b != a * c)
            continue;
        ray.t = -static_cast<double>(b) / static_cast<double>(a);
        rays.push_back(ray);
    }
    return rays;
}

template <class Real>
Ray<Real> ray_of(const TouchingRay& touching)
{
    const auto number = [](int value) { return static_cast<Real>(value); };
    Ray<Real> ray{{number(touching.org[0]), number(touching.org[1]), number(touching.org[2])},
                  {number(touching.dir[0]), number(touching.dir[1]), number(touching.dir[2])}};
    return ray;
}

/// The error of a double root, relative to 1 + |t|: half the digits of the deciding precision. That
/// is double, except for the scalar reference in single precision.
constexpr double of_double = 2e-6;
constexpr double of_single = 2e-3;

template <class Real>
void check_touching(const RayScene<Real>& scene, const TouchingRay& touching, double precision)
{
    const double slack = precision * (1.0 + std::abs(touching.t));
    const auto is_near = [&](Real t) { return std::abs(t - touching.t) <= slack; };
    Ray<Real> ray = ray_of<Real>(touching);
    INFO(ray.org[0] << ' ' << ray.org[1] << ' ' << ray.org[2] << " towards " << ray.dir[0] << ' '
                    << ray.dir[1] << ' ' << ray.dir[2] << " touches at " << touching.t);
    for (const SurfaceHit<Real>& hit : scene.all_hits(ray))
        CHECK(is_near(hit.t));
    if (const SurfaceHit<Real> hit = scene.closest_hit(ray); hit.object >= 0)
        CHECK(is_near(hit.t));
    ray.t_max = static_cast<Real>(touching.t - slack);
    if (ray.t_max > 0) {
        CHECK_FALSE(scene.occluded(ray));
        CHECK(scene.closest_hit(ray).object == -1);
        CHECK(scene.all_hits(ray).empty());
    }
    ray.t_max = std::numeric_limits<Real>::infinity();
    ray.t_min = static_cast<Real>(std::max(0.0, touching.t) + slack);
    CHECK_FALSE(scene.occluded(ray));
    CHECK(scene.closest_hit(ray).object == -1);
    CHECK(scene.all_hits(ray).empty());
}

template <class Real>
void check_all(const RenderOptions& options, double precision = of_double)
{
    for (const Touched& body : bodies) {
        INFO(body.text);
        const std::vector<TouchingRay> rays = rays_that_touch(body);
        REQUIRE(rays.size() > 20);
        const RayScene<Real> scene(parse_scene(body.text, "body", {}), options);
        for (const TouchingRay& ray : rays)
            check_touching(scene, ray, precision);
    }
}

}  // namespace

TEST_CASE("A ray that touches a body hits it at the point of contact or misses it", "[tangents]")
{
    for (const RenderOptions& options : packet_ways()) {
        INFO(options.isa);
        check_all<float>(options);
        check_all<double>(options);
    }
    check_all<float>({.kernel = Kernel::scalar}, of_single);
    check_all<double>({.kernel = Kernel::scalar});
}

TEST_CASE("The first hit is the first of all hits, however close to touching", "[tangents]")
{
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (const char* text : {"ellipsoid { }", "sphere { center = (0, 0, 0)  radius = 1 }",
                             "ellipsoid { scale = (3, 1, 0.2) }", "cylinder { }"})
        for (const RenderOptions& options : packet_ways()) {
            const RayScene<double> scene(parse_scene(text, "body", {}), options);
            int hits = 0;
            for (int i = 0; i < 4000; ++i) {
                // Along a tangent of the unit sphere, or of the body it is scaled to.
                const Vec3 up = glm::normalize(Vec3(any(random), any(random), any(random)));
                const Vec3 along = glm::cross(up, Vec3(any(random), any(random), any(random)));
                const double off = 1.0 - std::pow(10.0, -12.0 - 4.0 * std::abs(any(random)));
                const Vec3 org = off * up - along;
                const Ray<double> ray{{org.x, org.y, org.z}, {along.x, along.y, along.z}};
                const SurfaceHit<double> first = scene.closest_hit(ray);
                const std::vector<SurfaceHit<double>> all = scene.all_hits(ray);
                REQUIRE((first.object >= 0) == !all.empty());
                if (all.empty())
                    continue;
                ++hits;
                CHECK(first.t == all[0].t);
            }
            CHECK(hits > 100);
        }
}

TEST_CASE("A hit too far away for single precision is a miss", "[tangents]")
{
    const Scene scene = parse_scene(
        "cylinder { name = c }\n"
        "plane { point = (0, 0, 1)  normal = (0, 0, 1)  name = p }\n",
        "far", {});
    for (const RenderOptions& options : packet_ways()) {
        const RayScene<float> rays(scene, options);
        for (const Ray<float>& ray :
             {Ray<float>{{0, 0, 2}, {1e-40f, 0, 1}}, Ray<float>{{2, 0, 0}, {1, 0, 1e-40f}}}) {
            CHECK(rays.closest_hit(ray).object == -1);
            CHECK_FALSE(rays.occluded(ray));
            CHECK(rays.all_hits(ray).empty());
        }
    }
}

}  // namespace packtrace::test
