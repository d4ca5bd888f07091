// Hits of quadrics: single precision decides where it is sure, double elsewhere.
#include "catch.hpp"
#include "packet_ways.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>

#include <cmath>
#include <span>
#include <vector>

namespace packtrace::test {
namespace {

/// Every kind of quadric: whole, open, clipped and capped, with roots on both sides of clips.
Scene every_quadric()
{
    return parse_scene(R"(
        ellipsoid { scale = (0.9, 0.5, 0.6)  rotate = (0, 1, 0, 30)  translate = (-3, 0, 0) }
        cylinder { z_range = (-1.5, 1.5)  scale = (0.6, 0.5, 0.5)  rotate = (0, 1, 0, 65)  translate = (0, 0, 0) }
        cone { z_range = (-1, -0.1)  capped = true  rotate = (1, 0, 0, -90)  translate = (3, 0, 0) }
        paraboloid { z_range = (-0.1, 1)  rotate = (1, 0, 0, -70)  translate = (-3, 0, 3) }
        hyperboloid { z_range = (-1, 1)  scale = (0.4, 0.4, 0.7)  rotate = (1, 0, 0, -80)  translate = (0, 0, 3) }
        hyperboloid2 { z_range = (-2, 2)  capped = true  scale = 0.4  translate = (3, 0, 3) }
        cone { z_range = (-1, 1)  scale = (0.7, 0.7, -0.8)  rotate = (1, 0, 0, -80)  translate = (-3, 0, 6) }
        quadric { coefficients = (1, 2, 3, 1, -1, 0, 0, 0, 0, -0.8)  translate = (0, 0, 6) }
        cylinder { z_range = (-1, 1)  capped = true  scale = 0.6  rotate = (1, 1, 0, 50)  translate = (3, 0, 6) }
        saddle { scale = (4, 4, 1)  translate = (0, 0, 12) }
    )",
                       "quadrics", {});
}

/// Rays from one point towards the objects of every_quadric(), and beside them.
std::vector<Ray<float>> rays_from(const Vec3& eye, SceneRandom& random, int count)
{
    std::vector<Ray<float>> rays;
    for (int i = 0; i < count; ++i) {
        const Vec3 aim(3 * (i % 3 - 1) + random.between(-1, 1), random.between(-1, 1),
                       3 * (i / 3 % 3) + random.between(-1, 1));
        Ray<float> ray;
        for (int axis = 0; axis < 3; ++axis) {
            ray.org[axis] = static_cast<float>(eye[axis]);
            ray.dir[axis] = static_cast<float>(aim[axis] - eye[axis]);
        }
        rays.push_back(ray);
    }
    return rays;
}

std::vector<SurfaceHit<float>> hits_of(const RayScene<float>& scene,
                                       std::span<const Ray<float>> rays)
{
    std::vector<SurfaceHit<float>> hits(rays.size());
    scene.closest_hits(RayStructs<float>(rays), HitStructs<float>(hits));
    return hits;
}

/// The number of first hits that are more than one last place from all hits that double finds of
/// their object.
int not_among_all_hits(const RayScene<float>& scene, std::span<const Ray<float>> rays,
                       std::span<const SurfaceHit<float>> hits)
{
    int beyond = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].object < 0)
            continue;
        const auto t = double{hits[i].t};
        const double ulp = std::ldexp(0x1p-23, std::ilogb(t));
        const auto all = scene.all_hits(rays[i]);
        bool held = false;
        for (const SurfaceHit<float>& hit : all)
            held = held || (hit.object == hits[i].object && std::abs(double{hit.t} - t) <= ulp);
        beyond += held ? 0 : 1;
    }
    return beyond;
}

}  // namespace

TEST_CASE("Hits of quadrics have the same bits for rays from one place, from many and alone",
          "[quadric_hits]")
{
    const Scene scene = every_quadric();
    SceneRandom random(41);
    const Vec3 eyes[] = {{0.3, 2, -6}, {-1, 40, 9}, {300, 500, -200}, {0.1, 0.2, 4.4}};
    std::vector<std::vector<Ray<float>>> from;
    for (const Vec3& eye : eyes)
        from.push_back(rays_from(eye, random, 1800));
    std::vector<Ray<float>> mixed;
    for (std::size_t i = 0; i < from[0].size(); ++i)
        for (const auto& rays : from)
            mixed.push_back(rays[i]);
    std::vector<SurfaceHit<float>> first;
    for (const RenderOptions& options : packet_ways()) {
        // Without fused products everything may differ in the last place.
        if (options.isa == "sse42")
            continue;
        INFO(options.isa << (options.traversal == Traversal::tree ? " tree" : " list"));
        const RayScene<float> traced(scene, options);
        const auto together = hits_of(traced, mixed);
        if (first.empty())
            first = together;
        int differ = 0;
        for (std::size_t i = 0; i < together.size(); ++i)
            differ += same_bits(together[i], first[i]) ? 0 : 1;
        CHECK(differ == 0);
        for (std::size_t eye = 0; eye < from.size(); ++eye) {
            const auto shared = hits_of(traced, from[eye]);
            int other = 0;
            for (std::size_t i = 0; i < shared.size(); ++i) {
                other += same_bits(shared[i], first[i * from.size() + eye]) ? 0 : 1;
                if (i % 50 == 0)
                    other += same_bits(hits_of(traced, {&from[eye][i], 1})[0], shared[i]) ? 0 : 1;
            }
            CHECK(other == 0);
        }
    }
    const RayScene<float> traced(scene);
    int hit = 0;
    for (const SurfaceHit<float>& one : first)
        hit += one.object >= 0 ? 1 : 0;
    CHECK(hit > 4000);
    CHECK(not_among_all_hits(traced, mixed, first) == 0);
}

TEMPLATE_TEST_CASE("a narrow waist far from the origin of object space keeps its width",
                   "[quadric_hits]", float, double)
{
    // (x - 1024)² + y² - z² = 2^-20, whose waist is 2^-10 wide.
    const Scene scene = parse_scene(
        "quadric { coefficients = (1, 1, -1, 0, 0, 0, -2048, 0, 0, 1048575.99999904632568359375) }",
        "waist", {});
    for (const RenderOptions& options : packet_ways()) {
        INFO(options.isa << (options.traversal == Traversal::tree ? " tree" : " list"));
        const RayScene<TestType> traced(scene, options);
        CHECK(traced.closest_hit({.org = {1024, -5, 0}, .dir = {0, 1, 0}}).t ==
              TestType(5 - 0x1p-10));
        // Through the waist, where a cone would be in the way.
        const Ray<TestType> inside{.org = {1024, TestType(0x1p-11), -5}, .dir = {0, 0, 1}};
        CHECK(traced.closest_hit(inside).object == -1);
        CHECK(!traced.occluded(inside));
        CHECK(traced.all_hits(inside).empty());
    }
}

TEST_CASE("a tiny curvature of a parabolic cylinder shows in its hits", "[quadric_hits]")
{
    // x² + x = 2^-41 z, at (2^-11, 0, 2^30 + 2^19): not the planes x = 0 and x = -1.
    const RayScene<double> sheet(parse_scene(
        "quadric { coefficients = (1, 0, 0, 0, 0, 0, 1, 0, -4.547473508864641189575195e-13, 0) }",
        "sheet", {}));
    CHECK(sheet.closest_hit({.org = {0.25, 3, 0x1p30 + 0x1p19}, .dir = {-1, 0, 0}}).t ==
          Approx(0.25 - 0x1p-11).epsilon(1e-15));
}

TEST_CASE("a small ball written as a quadric far from the origin is a ball", "[quadric_hits]")
{
    const RayScene<double> ball(parse_scene(
        "quadric { coefficients = (1, 1, 1, 0, 0, 0, -2048, 0, 0, 1048575.99999904632568359375) }",
        "ball", {}));
    CHECK(ball.closest_hit({.org = {1024, 0, -5}, .dir = {0, 0, 1}}).t == 5 - 0x1p-10);
    CHECK(ball.closest_hit({.org = {1024, 0x1p-9, -5}, .dir = {0, 0, 1}}).object == -1);
}

TEST_CASE("a cone with rounded numbers has its apex", "[quadric_hits]")
{
    // The roundings of 0.1, 0.2, 0.3 and their squares must not turn the apex into a tiny waist or
    // gap.
    const RayScene<double> cone(parse_scene(
        "quadric { coefficients = (1, 1, -1, 0, 0, 0, -0.2, -0.4, 0.6, -0.04) }", "cone", {}));
    const SurfaceHit<double> hit = cone.closest_hit({.org = {0.1, -5, 0.3}, .dir = {0, 1, 0}});
    CHECK(hit.object == 0);
    CHECK(hit.t == Approx(5.2).epsilon(1e-14));
}

TEMPLATE_TEST_CASE("rays along an open tube hit nothing beyond its ends", "[quadric_hits]", float,
                   double)
{
    // Each ray runs exactly along the wall, where rounding may find a hit or a miss; along the ray,
    // the tube is between `low` and `high`.
    struct Along {
        std::string tube;
        Ray<TestType> ray;
        TestType low, high;
    };
    const Along cases[] = {
        {"cylinder { z_range = (0, 1)  matrix = (1, 1, 1, 0, -1, 1, 2, 0, 0, -1, 1, 0) }",
         {.org = {8, 13, 7}, .dir = {-1, -2, -1}},
         6,
         7},
        {"cylinder { z_range = (0, 1)  matrix = (1, 1, 3, 0, -1, 1, 2, 0, 0, -1, 1, 0) }",
         {.org = {17, 11, 7}, .dir = {-3, -2, -1}},
         5,
         6},
        {"quadric { coefficients = (1, 0, 0, 0, 0, 0, 0, -1, 0, 0)  z_range = (0, 1)"
         "  matrix = (1, 2, 1, 0, 0, 1, 3, 0, 1, 0, 1, 0) }",
         {.org = {29, 61, 21}, .dir = {-1, -3, -1}},
         18,
         19}};
    for (const Along& along : cases) {
        const Scene scene = parse_scene(along.tube, "tube", {});
        for (const RenderOptions& options : packet_ways()) {
            CAPTURE(along.tube, options.isa, options.traversal);
            const RayScene<TestType> traced(scene, options);
            const auto is_on_tube = [&](const SurfaceHit<TestType>& hit) {
                return hit.t > along.low * TestType(0.999) && hit.t < along.high * TestType(1.001);
            };
            const SurfaceHit<TestType> hit = traced.closest_hit(along.ray);
            CHECK((hit.object == -1 || is_on_tube(hit)));
            for (const SurfaceHit<TestType>& one : traced.all_hits(along.ray))
                CHECK(is_on_tube(one));
            Ray<TestType> shorter = along.ray;
            shorter.t_max = along.low - 1;
            CHECK(traced.closest_hit(shorter).object == -1);
            CHECK(!traced.occluded(shorter));
        }
    }
}

}  // namespace packtrace::test
