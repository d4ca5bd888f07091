// Surfaces of the scalar reference against intersections worked out by hand.
#include "catch.hpp"
#include "reference/all_hits.hpp"
#include "reference_scenes.hpp"

#include <cmath>
#include <vector>

namespace packtrace::test {
namespace {

using V = reference::Vec3<double>;
using Hits = std::vector<reference::SurfaceHit<double>>;

constexpr double inf = reference::infinity<double>;

//                                            A  B   C  D  E  F  G  H   I   J
constexpr std::array<double, 10> ellipsoid = {1, 1, 1, 0, 0, 0, 0, 0, 0, -1};
constexpr std::array<double, 10> cylinder = {1, 1, 0, 0, 0, 0, 0, 0, 0, -1};
constexpr std::array<double, 10> cone = {1, 1, -1, 0, 0, 0, 0, 0, 0, 0};
constexpr std::array<double, 10> paraboloid = {1, 1, 0, 0, 0, 0, 0, 0, -1, 0};
constexpr std::array<double, 10> hyperboloid = {1, 1, -1, 0, 0, 0, 0, 0, 0, -1};
constexpr std::array<double, 10> hyperboloid2 = {1, 1, -1, 0, 0, 0, 0, 0, 0, 1};
constexpr std::array<double, 10> saddle = {1, -1, 0, 0, 0, 0, 0, 0, -1, 0};
constexpr std::array<double, 10> slab = {0, 0, 1, 0, 0, 0, 0, 0, 0, -1};
constexpr std::array<double, 10> xy_is_one = {0, 0, 0, 1, 0, 0, 0, 0, 0, -1};

Hits hits_of(const Object& object, const V& org, const V& dir, double t_min = -inf)
{
    Scene scene;
    scene.objects = {object};
    return reference::all_hits(reference::Bodies<double>(scene), org, dir, t_min, inf);
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

TEST_CASE("each quadric is met where its equation says", "[reference_quadrics]")
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

TEST_CASE("a ray that meets a quadric once gets that one root", "[reference_quadrics]")
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

TEST_CASE("normals go up the gradient", "[reference_quadrics]")
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

TEST_CASE("a z range keeps the part within, its ends included", "[reference_quadrics]")
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
    // Both nappes of a cone: two caps and, through its waist, two sides.
    const Object hourglass = clipped(quadric(cone), -2, 2, true);
    check_t(hits_of(hourglass, {1, 0, -3}, {0, 0, 1}), {1, 2, 4, 5});
    // A saddle's inside at z = 0 is x² < y².
    const Object piece = clipped(quadric(saddle), 0, 1, true);
    check_t(hits_of(piece, {0, 1, -1}, {0, 0, 1}), {1, 2});
}

TEST_CASE("a shear takes surface and normal along", "[reference_quadrics]")
{
    // World x is own x + own z: at z = 2 the cylinder spans x = 1 to 3.
    Object object = quadric(cylinder);
    object.transform[2][0] = 1.0;
    const Hits hits = hits_of(object, {-3, 0, 2}, {1, 0, 0});
    check_t(hits, {4, 6});
    check_color(hits[0].normal, Rgb(-1, 0, 1) / std::sqrt(2.0));
    check_color(hits[1].normal, Rgb(1, 0, -1) / std::sqrt(2.0));
}

TEST_CASE("a mirroring matrix leaves the outside outside", "[reference_quadrics]")
{
    Object object = quadric(ellipsoid);
    object.transform[0][0] = -2.0;
    const Hits hits = hits_of(object, {-5, 0, 0}, {1, 0, 0});
    check_t(hits, {3, 7});
    check_color(hits[0].normal, Rgb(-1, 0, 0));
}

TEST_CASE("a far origin costs no digits", "[reference_quadrics]")
{
    const Hits hits = hits_of(quadric(ellipsoid), {0.6, 0, -1e6}, {0, 0, 2}, 0);
    REQUIRE(hits.size() == 2);
    CHECK(hits[0].t == Approx((1e6 - 0.8) / 2).epsilon(1e-15));
    CHECK(hits[1].t == Approx((1e6 + 0.8) / 2).epsilon(1e-15));
}

TEST_CASE("all hits come sorted by t, then object, within the range", "[reference_quadrics]")
{
    Scene scene;
    scene.objects = {sphere({0, 0, 5}, 1), plane({0, 0, 4}, {0, 0, 1}), sphere({0, 0, 5}, 2)};
    const reference::Bodies<double> bodies(scene);
    const Hits hits = reference::all_hits(bodies, V(0, 0, 0), V(0, 0, 1), 0.0, inf);
    check_t(hits, {3, 4, 4, 6, 7});
    CHECK(hits[0].object == 2);
    CHECK(hits[1].object == 0);
    CHECK(hits[2].object == 1);
    check_t(reference::all_hits(bodies, V(0, 0, 0), V(0, 0, 1), 3.5, 6.0), {4, 4, 6});
    CHECK(reference::all_hits(bodies, V(0, 0, 0), V(1, 0, 0), 0.0, inf).empty());
}

TEST_CASE("in scratch a sphere's normal stays outside, other normals face the viewer",
          "[reference_quadrics]")
{
    // Seen from inside, with a light far beyond the surface: only the sphere is lit by it.
    Scene scene;
    scene.shadows = ShadowKind::none;
    scene.lights = {directional({0, 0, 1}, 1)};
    const V eye(0, 0, 0);
    scene.objects = {sphere({0, 0, 0}, 2, matte(Rgb(1)))};
    check_color(trace(scene, eye, {0, 0, 1}), Rgb(1));
    scene.objects[0].transform[0][0] = 3.0;
    check_color(trace(scene, eye, {0, 0, 1}), Rgb(1));
    scene.objects = {quadric(ellipsoid, matte(Rgb(1)))};
    scene.objects[0].transform[2][2] = 2.0;
    check_color(trace(scene, eye, {0, 0, 1}), Rgb(0));
}

}  // namespace packtrace::test
