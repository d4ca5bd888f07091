// Polygons with a transform that flattens or stretches them, where double loses digits of their
// normals.
#include "catch.hpp"
#include "lab/truth/wide_truth.hpp"
#include "packet_ways.hpp"
#include "scenes.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

Vec3 any_vector(SceneRandom& random)
{
    return {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
}

Mat4 any_turn(SceneRandom& random)
{
    return glm::rotate(Mat4(1.0), random.between(-3.0, 3.0), any_vector(random));
}

Ray<double> ray_of(const Vec3& org, const Vec3& dir)
{
    return {{org.x, org.y, org.z}, {dir.x, dir.y, dir.z}};
}

/// A parallelogram around the origin, and its two half diagonals.
struct Flattened {
    Object object;
    Vec3 u, v;
};

Flattened flattened(SceneRandom& random, double least)
{
    const double share = std::pow(least, random.between(0.0, 1.0));
    Flattened made{{}, any_vector(random), any_vector(random)};
    made.object.surface = Polygon{{{-made.u, made.v, made.u, -made.v}}};
    made.object.transform =
        any_turn(random) * glm::scale(Mat4(1.0), Vec3(1.0, 1.0, share)) * any_turn(random);
    return made;
}

/// What rounding may make of a t, in units of what it may be off by, when all that is given is
/// rounded once.
constexpr double most_units = 100.0;

void check_hits(const Flattened& polygon, const RayScene<double>& scene, SceneRandom& random)
{
    const lab::WideSurface surface(polygon.object, 0);
    for (int i = 0; i < 20; ++i) {
        const double along = random.between(-0.4, 0.4);
        const double across = random.between(-0.4, 0.4);
        const Vec3 target(polygon.object.transform *
                          glm::dvec4(along * polygon.u + across * polygon.v, 1.0));
        const Vec3 org = target + 2.0 * any_vector(random);
        const Vec3 dir = target - org;
        std::vector<lab::TrueHit> found;
        lab::find_true_hits(surface, {org, dir, 0.0, std::numeric_limits<double>::infinity()},
                            found);
        REQUIRE(found.size() == 1);
        if (!found[0].exists || found[0].margin < 1e-9)
            continue;
        const SurfaceHit<double> hit = scene.closest_hit(ray_of(org, dir));
        REQUIRE(hit.object == 0);
        const auto truth = static_cast<double>(found[0].t);
        CHECK(std::abs(hit.t - truth) <= most_units * 0x1p-53 * found[0].condition * truth);
    }
}

}  // namespace

TEST_CASE("flattened polygons are hit where 113 bits say", "[flattened_polygons]")
{
    std::vector<RenderOptions> ways = packet_ways();
    ways.push_back({.kernel = Kernel::scalar});
    for (const double least : {1e-3, 1e-6, 1e-9})
        for (const RenderOptions& options : ways) {
            CAPTURE(least, options.isa, options.kernel == Kernel::scalar);
            SceneRandom random(17);
            for (int i = 0; i < 40; ++i) {
                const Flattened polygon = flattened(random, least);
                Scene scene;
                scene.objects = {polygon.object};
                check_hits(polygon, RayScene<double>(scene, options), random);
            }
        }
}

TEST_CASE("of a flattened polygon and one behind it the first is hit", "[flattened_polygons]")
{
    const Scene scene = parse_scene(R"(
polygon { vertices = (-0.4893044582406407,0.20989554005518818,-1.310162207289912),
                     (1.0762066504088899,-0.754013304226122,-0.5227266806522154),
                     (0.4893044582406407,-0.20989554005518818,1.310162207289912),
                     (-1.0762066504088899,0.754013304226122,0.5227266806522154)
          matrix = (0.24578091361398946,-0.9044814605704397,0.3472080557098143,0,
                    0.4962956790009921,0.14988348848180366,0.11442196688259929,0,
                    0.7792103667913067,0.29228785818657427,0.16273831957930476,0) }
polygon { vertices = (-2.2024777293079203,-3.6261555703017256,-0.00936118968898314),
                     (2.38756543496137,-1.458408669573959,3.189447514270965),
                     (2.202477733167615,3.626155567967613,0.009361185732384536),
                     (-2.387565431101675,1.458408667239847,-3.1894475182275634) }
)",
                                    "flattened", {});
    const Vec3 dir(0.6432825172674363, -0.38901870451669246, -0.659433128159501);
    for (const RenderOptions& options : packet_ways()) {
        const RayScene<double> rays(scene, options);
        for (const Vec3& org :
             {Vec3(-0.3372796396494837, 0.5335351645652102, 0.8726870417568308),
              Vec3(-0.03127676203153096, 0.678051624613728, 1.0859409553541606)}) {
            CAPTURE(options.isa, org.x);
            const SurfaceHit<double> hit = rays.closest_hit(ray_of(org, dir));
            CHECK(hit.object == 0);
            CHECK(std::abs(hit.t - 1.0) < 1e-14);
        }
    }
}

TEST_CASE("polygons keep their sides under reflections", "[flattened_polygons]")
{
    SceneRandom random(3);
    for (int i = 0; i < 200; ++i) {
        const Flattened polygon = flattened(random, i % 2 == 0 ? 1.0 : 1e-9);
        for (const double side : {1.0, -1.0}) {
            Scene scene;
            scene.objects = {polygon.object};
            Mat4& place = scene.objects[0].transform;
            place = glm::scale(Mat4(1.0), Vec3(side, 1.0, 1.0)) * place;
            // Starts slightly off the polygon, on the side that its normal points to.
            const Vec3 normal = polygon_normal(std::get<Polygon>(polygon.object.surface));
            const Vec3 org(place * glm::dvec4(normal, 1.0));
            const SurfaceHit<double> hit = RayScene<double>(scene).closest_hit(ray_of(org, -org));
            REQUIRE(hit.object == 0);
            CHECK(glm::dot(Vec3(hit.normal[0], hit.normal[1], hit.normal[2]), org) > 0.0);
        }
    }
}

TEST_CASE("polygons are hit from as far away as rays may start", "[flattened_polygons]")
{
    const Scene scene =
        parse_scene("polygon { vertices = (-1,-1,0),(-1,1,0),(1,1,0),(1,-1,0) }", "square", {});
    std::vector<RenderOptions> ways = packet_ways();
    ways.push_back({.kernel = Kernel::scalar});
    for (const RenderOptions& options : ways) {
        const RayScene<double> rays(scene, options);
        for (const auto& [from, length] :
             {std::pair(1e120, 1e100), std::pair(1e150, 1e10), std::pair(1e150, 1.0)}) {
            CAPTURE(options.isa, from, length);
            CHECK(rays.closest_hit(ray_of(Vec3(-from), Vec3(length))).object == 0);
        }
    }
}

}  // namespace packtrace::test
