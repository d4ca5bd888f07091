// Surfaces of the scalar reference against intersections computed by hand.
#include "catch.hpp"
#include "reference/surfaces/hits.hpp"
#include "reference_scenes.hpp"
#include <packtrace/build.hpp>
#include <packtrace/read_scene.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace packtrace::test {
namespace {

using V = reference::Vec3<double>;
using Hits = std::vector<reference::SurfaceHit<double>>;

constexpr double infinite = reference::infinity<double>;

//                                            A  B   C  D  E  F  G  H   I   J
constexpr std::array<double, 10> ellipsoid = {1, 1, 1, 0, 0, 0, 0, 0, 0, -1};
constexpr std::array<double, 10> cylinder = {1, 1, 0, 0, 0, 0, 0, 0, 0, -1};
constexpr std::array<double, 10> cone = {1, 1, -1, 0, 0, 0, 0, 0, 0, 0};
constexpr std::array<double, 10> paraboloid = {1, 1, 0, 0, 0, 0, 0, 0, -1, 0};
constexpr std::array<double, 10> hyperboloid = {1, 1, -1, 0, 0, 0, 0, 0, 0, -1};
constexpr std::array<double, 10> hyperboloid2 = {1, 1, -1, 0, 0, 0, 0, 0, 0, 1};
constexpr std::array<double, 10> saddle = {1, -1, 0, 0, 0, 0, 0, 0, -1, 0};
constexpr std::array<double, 10> slab = {0, 0, 1, 0, 0, 0, 0, 0, 0, -1};
constexpr std::array<double, 10> crossing_planes = {1, 0, -1, 0, 0, 0, 0, 0, 0, 0};
constexpr std::array<double, 10> turned_crossing_planes = {-0.28, 0, 0.28, 0, 1.92, 0, 0, 0, 0, 0};
constexpr std::array<double, 10> xy_is_one = {0, 0, 0, 1, 0, 0, 0, 0, 0, -1};

Hits hits_of(const Object& object, const V& org, const V& dir, double t_min = -infinite)
{
    Scene scene{.objects = {object}};
    return reference::all_hits(reference::Bodies<double>(scene), org, dir, t_min, infinite);
}

void check_t(const Hits& hits, const std::vector<double>& expected)
{
    REQUIRE(hits.size() == expected.size());
    for (std::size_t i = 0; i < hits.size(); ++i)
        CHECK(hits[i].t == Approx(expected[i]).epsilon(1e-14));
}

Object clipped(Object object, double low, double high, bool capped)
{
    auto& surface = std::get<Quadric>(object.surface);
    surface.z_range = ZRange{low, high};
    surface.capped = capped;
    return object;
}

}  // namespace

TEST_CASE("each quadric is hit where its equation says", "[reference_quadrics]")
{
    check_t(hits_of(quadric(ellipsoid), {0.6, 0, -3}, {0, 0, 1}), {2.2, 3.8});
    check_t(hits_of(quadric(cylinder), {-3, 0.6, 5}, {1, 0, 0}), {2.2, 3.8});
    check_t(hits_of(quadric(cone), {-3, 0, 1}, {1, 0, 0}), {2, 4});
    check_t(hits_of(quadric(paraboloid), {-3, 0, 4}, {1, 0, 0}), {1, 5});
    check_t(hits_of(quadric(hyperboloid), {-5, 0, 0.75}, {1, 0, 0}), {3.75, 6.25});
    check_t(hits_of(quadric(hyperboloid2), {0.75, 0, -5}, {0, 0, 1}), {3.75, 6.25});
    check_t(hits_of(quadric(saddle), {-3, 0, 4}, {1, 0, 0}), {1, 5});
    check_t(hits_of(quadric(slab), {9, 9, -3}, {0, 0, 1}), {2, 4});
}

TEST_CASE("a ray with one hit of a quadric gets that one root", "[reference_quadrics]")
{
    check_t(hits_of(quadric(paraboloid), {0.5, 0, 10}, {0, 0, -1}), {9.75});
    check_t(hits_of(quadric(saddle), {2, 1, 10}, {0, 0, -1}), {7});
    check_t(hits_of(quadric(cone), {-3, 0, 1}, {1, 0, 1}), {1});
    check_t(hits_of(quadric(xy_is_one), {-1, 2, 0}, {1, 0, 0}), {1.5});
}

TEST_CASE("a ray along a cylinder's axis misses its side", "[reference_quadrics]")
{
    CHECK(hits_of(quadric(cylinder), {0, 0, 0}, {0, 0, 1}).empty());
    CHECK(hits_of(quadric(cylinder), {0.5, 0, 0}, {0, 0, 1}).empty());
    CHECK(hits_of(quadric(cylinder), {2, 0, 0}, {0, 0, 1}).empty());
    CHECK(hits_of(quadric(slab), {0, 0, 0}, {1, 0, 0}).empty());
}

TEST_CASE("normals point along the gradient", "[reference_quadrics]")
{
    const double size = std::sqrt(16.0 + 4 + 1);
    check_color(hits_of(quadric(saddle), {2, 1, 10}, {0, 0, -1})[0].normal,
                Rgb(4 / size, -2 / size, -1 / size));
    check_color(hits_of(quadric(xy_is_one), {-1, 2, 0}, {1, 0, 0})[0].normal,
                Rgb(2, 0.5, 0) / std::sqrt(4.25));
    const Hits through = hits_of(quadric(slab), {9, 9, -3}, {0, 0, 1});
    check_color(through[0].normal, Rgb(0, 0, -1));
    check_color(through[1].normal, Rgb(0, 0, 1));
}

TEST_CASE("a z range keeps the part within it, including its ends", "[reference_quadrics]")
{
    const Object open = clipped(quadric(cylinder), 0, 2, false);
    check_t(hits_of(open, {-3, 0, 1}, {1, 0, 0}), {2, 4});
    check_t(hits_of(open, {-3, 0, 2}, {1, 0, 0}), {2, 4});
    CHECK(hits_of(open, {-3, 0, 2.001}, {1, 0, 0}).empty());
    // In through the open end, out through the side at x = 1, z = 1.
    check_t(hits_of(open, {-1, 0, 3}, {1, 0, -1}), {2});
}

TEST_CASE("caps close the ends of a clipped quadric", "[reference_quadrics]")
{
    const Object can = clipped(quadric(cylinder), 0, 2, true);
    const Hits along = hits_of(can, {0.5, 0, -1}, {0, 0, 1});
    check_t(along, {1, 3});
    check_color(along[0].normal, Rgb(0, 0, -1));
    check_color(along[1].normal, Rgb(0, 0, 1));
    CHECK(hits_of(can, {1.5, 0, -1}, {0, 0, 1}).empty());
    // Through the lid at (0, 0, 2), out of the side at (1, 0, 1).
    const Hits slanted = hits_of(can, {-1, 0, 3}, {1, 0, -1});
    check_t(slanted, {1, 2});
    check_color(slanted[0].normal, Rgb(0, 0, 1));
    check_color(slanted[1].normal, Rgb(1, 0, 0));
    // Both halves of a cone: two caps and, through the apex, two sides.
    const Object hourglass = clipped(quadric(cone), -2, 2, true);
    check_t(hits_of(hourglass, {1, 0, -3}, {0, 0, 1}), {1, 2, 4, 5});
    // A saddle's inside at z = 0 is x² < y².
    const Object piece = clipped(quadric(saddle), 0, 1, true);
    check_t(hits_of(piece, {0, 1, -1}, {0, 0, 1}), {1, 2});
}

TEST_CASE("a shear moves both surface and normal", "[reference_quadrics]")
{
    // World x is own x + own z: at z = 2 the cylinder spans x = 1 to 3.
    Object object = quadric(cylinder);
    object.transform[2][0] = 1.0;
    const Hits hits = hits_of(object, {-3, 0, 2}, {1, 0, 0});
    check_t(hits, {4, 6});
    check_color(hits[0].normal, Rgb(-1, 0, 1) / std::sqrt(2.0));
    check_color(hits[1].normal, Rgb(1, 0, -1) / std::sqrt(2.0));
}

TEST_CASE("a reflection keeps the outside outside", "[reference_quadrics]")
{
    Object object = quadric(ellipsoid);
    object.transform[0][0] = -2.0;
    const Hits hits = hits_of(object, {-5, 0, 0}, {1, 0, 0});
    check_t(hits, {3, 7});
    check_color(hits[0].normal, Rgb(-1, 0, 0));
}

TEST_CASE("a far origin loses no digits", "[reference_quadrics]")
{
    const Hits hits = hits_of(quadric(ellipsoid), {0.6, 0, -1e6}, {0, 0, 2}, 0);
    REQUIRE(hits.size() == 2);
    CHECK(hits[0].t == Approx((1e6 - 0.8) / 2).epsilon(1e-15));
    CHECK(hits[1].t == Approx((1e6 + 0.8) / 2).epsilon(1e-15));
}

TEMPLATE_TEST_CASE("any line hits both of two intersecting planes", "[reference_quadrics]", float,
                   double, long double)
{
    using Vec = reference::Vec3<TestType>;
    const TestType t_max = reference::infinity<TestType>;
    // Without a transform, turned by coefficients, and turned and moved by a matrix and by
    // coefficients.
    std::vector<Object> objects = {quadric(crossing_planes), quadric(turned_crossing_planes),
                                   quadric(crossing_planes),
                                   quadric({1, 0, -1, 0, 0, 0, -6, 0, 4, 5})};
    objects[2].transform[0] = {0.36, 0.48, -0.8, 0};
    objects[2].transform[1] = {-0.8, 0.6, 0, 0};
    objects[2].transform[3] = {3, -2, 5, 1};
    for (const Object& object : objects) {
        Scene scene{.objects = {object}};
        const reference::Bodies<TestType> bodies(scene);
        const reference::Affine<TestType> placement(object.transform);
        std::mt19937 random(5);
        std::uniform_real_distribution<double> place(-5, 5);
        int missed = 0;
        for (int i = 0; i < 20'000; ++i) {
            // Half of the rays pass through the edge of the untransformed planes.
            const Vec org(Vec3(place(random), place(random), place(random)));
            const Vec to(Vec3(i % 2 * place(random), place(random), i % 2 * place(random)));
            missed += reference::all_hits(bodies, placement.point_to_world(org),
                                          placement.vector_to_world(to - org), -t_max, t_max)
                          .size() != 2;
        }
        CHECK(missed == 0);
    }
}

TEST_CASE("a ray through the edge of intersecting planes hits them there", "[reference_quadrics]")
{
    const Hits hits = hits_of(quadric(crossing_planes), {0, 0, -5}, {0, 0.04, 0.2});
    check_t(hits, {25, 25});
    for (const auto& hit : hits)
        CHECK(reference::length(hit.normal) == Approx(1.0));
    Scene scene = parse_scene(
        "camera { position = (0.3, 0.2, -5) look_at = (0, 0, 0) "
        "up = (0.3, 1, 0.1) fov = 40 } light { type = ambient intensity = 1 }"
        "quadric { coefficients = (1, 0, -1, 0, 0, 0, 0, 0, 0, 0) }",
        "crossing");
    scene.width = scene.height = 512;
    CHECK(reference::Reference<double>(scene).trace_pixel(213, 116).x == 1.0);
}

TEST_CASE("a ray parallel to a cone's generator hits the cone once, whatever rounding says",
          "[reference_quadrics]")
{
    for (const V& dir : {V(0, 1, 1), V(0.6, 0.8, 1), V(1, 1e-17, 1)})
        CHECK(hits_of(quadric(cone), {3, 1, -2}, dir).size() == 1);
    // After the turn, the direction's rounding leaves a quadratic term of 1e-17.
    for (int degrees = 1; degrees < 90; ++degrees) {
        const double angle = degrees * std::acos(-1.0) / 180;
        Object object = quadric(cone);
        object.transform[0] = {std::cos(angle), std::sin(angle), 0, 0};
        object.transform[1] = {-std::sin(angle), std::cos(angle), 0, 0};
        object.transform[2] = {0, 0, 1, 0};
        const Hits hits = hits_of(object, {3, 1, -2}, {std::cos(angle), std::sin(angle), 1});
        CAPTURE(degrees);
        CHECK(hits.size() == 1);
    }
    CHECK(hits_of(quadric(cone), {3, 1, -2}, {0, 1, 1.00001}).size() == 2);
}

TEST_CASE("hits of a needle agree with long double", "[reference_quadrics]")
{
    // Half axes 1, 1e-3, 1e-3, turned, seen from ten lengths away.
    Scene scene{.objects = {quadric(ellipsoid)}};
    scene.objects[0].transform[0] = {0.36, 0.48, -0.8, 0};
    scene.objects[0].transform[1] = {-0.8e-3, 0.6e-3, 0, 0};
    scene.objects[0].transform[2] = {0.48e-3, 0.64e-3, 0.6e-3, 0};
    using Wide = reference::Vec3<long double>;
    const reference::Bodies<double> bodies(scene);
    const reference::Bodies<long double> wide(scene);
    const reference::Affine<double> placement(scene.objects[0].transform);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-0.57, 0.57);
    double worst = 0;
    for (int i = 0; i < 10'000; ++i) {
        const V org(10 * place(random), 10 * place(random), -10);
        const V dir = placement.point_to_world({place(random), place(random), place(random)}) - org;
        const auto hits = reference::all_hits(bodies, org, dir, 0.0, infinite);
        const auto truth =
            reference::all_hits(wide, Wide(org.x, org.y, org.z), Wide(dir.x, dir.y, dir.z), 0.0L,
                                reference::infinity<long double>);
        REQUIRE(hits.size() == 2);
        REQUIRE(truth.size() == 2);
        for (std::size_t k = 0; k < 2; ++k)
            worst = std::max(worst, std::abs(hits[k].t - static_cast<double>(truth[k].t)));
    }
    CHECK(worst <= 1e-14);
}

TEST_CASE("coefficients in general position are transformed to their axes", "[reference_quadrics]")
{
    // The ellipsoid x²/4 + y² + z² = 1 turned by 3-4-5 about z and moved to (1, 2, 3).
    const double c = 0.8, s = 0.6;
    const double A = c * c / 4 + s * s, B = s * s / 4 + c * c, D = 2 * c * s * (0.25 - 1);
    const double G = -2 * A - 2 * D, H = -4 * B - D;
    const Object moved = quadric({A, B, 1, D, 0, 0, G, H, -6, A + 4 * B + 2 * D + 9 - 1});
    const Hits hits = hits_of(moved, {1 + 5 * c, 2 + 5 * s, 3}, {-c, -s, 0});
    check_t(hits, {3, 7});
    check_color(hits[0].normal, Rgb(c, s, 0));
    // The paraboloid x² + y² = z turned onto the x axis, and one over a parabola alone.
    check_t(hits_of(quadric({0, 1, 1, 0, 0, 0, -1, 0, 0, 0}), {4, -3, 0}, {0, 1, 0}), {1, 5});
    check_t(hits_of(quadric({1, 0, 0, 0, 0, 0, 0, -0.6, -0.8, 0}), {2, -0.6, 7.2}, {0, 0.6, -0.8}),
            {5});
    check_t(hits_of(quadric({0, 0, 0, 0, 0, 0, 0, 0, 2, -4}), {0, 0, 0}, {0, 0, 1}), {2});
}

TEST_CASE("all hits come sorted by t, then object, within the range", "[reference_quadrics]")
{
    Scene scene{
        .objects = {sphere({0, 0, 5}, 1), plane({0, 0, 4}, {0, 0, 1}), sphere({0, 0, 5}, 2)}};
    const reference::Bodies<double> bodies(scene);
    const Hits hits = reference::all_hits(bodies, V(0, 0, 0), V(0, 0, 1), 0.0, infinite);
    check_t(hits, {3, 4, 4, 6, 7});
    CHECK(hits[0].object == 2);
    CHECK(hits[1].object == 0);
    CHECK(hits[2].object == 1);
    check_t(reference::all_hits(bodies, V(0, 0, 0), V(0, 0, 1), 3.5, 6.0), {4, 4, 6});
    CHECK(reference::all_hits(bodies, V(0, 0, 0), V(1, 0, 0), 0.0, infinite).empty());
}

TEST_CASE("in scratch a sphere's normal stays outward, and other normals face the viewer",
          "[reference_quadrics]")
{
    // Seen from inside, with a light far beyond the surface, which lights only the sphere.
    Scene scene{.shadows = ShadowKind::none, .lights = {directional({0, 0, 1}, 1)}};
    const V eye(0, 0, 0);
    scene.objects = {sphere({0, 0, 0}, 2, matte(Rgb(1)))};
    check_color(trace(scene, eye, {0, 0, 1}), Rgb(1));
    scene.objects[0].transform[0][0] = 3.0;
    check_color(trace(scene, eye, {0, 0, 1}), Rgb(1));
    scene.objects = {quadric(ellipsoid, matte(Rgb(1)))};
    scene.objects[0].transform[2][2] = 2.0;
    check_color(trace(scene, eye, {0, 0, 1}), Rgb(0));
}

TEST_CASE("intersecting planes are hit where each of them is, however far from their edge",
          "[reference_quadrics]")
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    // x = z and x = -z.
    const Object object = quadric(crossing_planes);
    for (int i = 0; i < 200; ++i) {
        const V org(3.0 * unit(random), unit(random), 3.0 * unit(random));
        const V dir(unit(random), unit(random), unit(random));
        std::vector<double> expected = {(org.z - org.x) / (dir.x - dir.z),
                                        -(org.z + org.x) / (dir.x + dir.z)};
        std::sort(expected.begin(), expected.end());
        const Hits hits = hits_of(object, org, dir);
        REQUIRE(hits.size() == 2);
        for (std::size_t k = 0; k < 2; ++k)
            CHECK(std::abs(hits[k].t - expected[k]) < 1e-9 * (1.0 + std::abs(expected[k])));
    }
}

TEST_CASE("of two intersecting planes one shades the other, but never itself",
          "[reference_quadrics]")
{
    // Seen at (-5/6, 0, 5/6), on x = -z, from the wedge of negative x.
    const auto brightness = [](const Vec3& light) {
        Scene scene = make_scene();
        scene.objects = {quadric(crossing_planes, matte(Rgb(1)))};
        scene.lights = {point_light(light, 1)};
        return trace(scene, {-5, 0, 0}, {1, 0, 0.2}).x;
    };
    CHECK(brightness({-6, 0, -1}) > 0.1);
    CHECK(brightness({-4, 0, -4}) > 0.1);
    CHECK(brightness({-1, 0, -6}) == 0);
    CHECK(brightness({-6, 0, -7}) == 0);
}

TEST_CASE("the value at two intersecting planes is the distance from the nearer",
          "[reference_quadrics]")
{
    Scene scene = make_scene();
    scene.objects = {quadric(turned_crossing_planes)};
    const auto bodies = reference::Bodies<double>(scene);
    const auto& body = bodies.placed.at(0);
    const V on(7, 2, 1);
    for (const double off : {-0.125, -1e-9, 0.0, 1e-9, 0.125}) {
        const V out = normal_at(body, on, reference::Part::side);
        const double size = length(out);
        const V place = on + (off / size) * out;
        CHECK(value_at(body, place, reference::Part::side) / size == Approx(off).margin(1e-14));
    }
}

}  // namespace packtrace::test
