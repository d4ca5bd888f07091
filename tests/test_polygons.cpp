// Reading, writing and packing polygons.
#include "catch.hpp"
#include "lower/packed_lists.hpp"
#include "lower/prune.hpp"
#include "polygon_scenes.hpp"
#include "scene_text.hpp"
#include <packtrace/read_scene.hpp>
#include <packtrace/validate.hpp>
#include <packtrace/write_scene.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <string>

namespace packtrace::test {
namespace {

const std::string triangle = "polygon { vertices = (0, 0, 3), (1, 0, 3), (0, 1, 3)";

}  // namespace

TEST_CASE("polygons are read contour by contour", "[polygons]")
{
    const Scene scene = parse(triangle + " vertices = (.1, .1, 3), (.2, .1, 3), (.1, .2, 3) }");
    const auto& surface = std::get<Polygon>(scene.objects[0].surface);
    CHECK(surface.contours ==
          Contours{{{0, 0, 3}, {1, 0, 3}, {0, 1, 3}}, {{.1, .1, 3}, {.2, .1, 3}, {.1, .2, 3}}});
    CHECK(polygon_normal(surface) == Vec3(0, 0, 1));
    CHECK(polygon_normal(Polygon{}) == Vec3(0.0));
    CHECK(scene.objects[0].name == "polygon 1");
}

TEST_CASE("a polygon is written as it is read", "[polygons]")
{
    Scene scene = polygon_scene({star(), cube_faces()[3]});
    PolygonRandom random(1);
    scene.objects[0].transform = some_transform(random);
    const Scene back = parse(scene_text(scene));
    REQUIRE(back.objects.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(std::get<Polygon>(back.objects[i].surface).contours ==
              std::get<Polygon>(scene.objects[i].surface).contours);
        CHECK(back.objects[i].transform == scene.objects[i].transform);
    }
}

TEST_CASE("a polygon of ten thousand corners is read", "[polygons]")
{
    std::string text = "polygon {\nvertices =";
    for (int i = 0; i < 10'000; ++i) {
        const double angle = 6.283185307179586 * i / 10'000;
        text += (i > 0 ? ",\n(" : " (") + std::to_string(std::cos(angle)) + ", " +
                std::to_string(std::sin(angle)) + ", 3)";
    }
    CHECK(std::get<Polygon>(parse(text + " }").objects[0].surface).contours[0].size() == 10'000);
}

TEST_CASE("invalid polygons are refused with what is wrong", "[polygons]")
{
    CHECK(
        error_of("polygon { }") ==
        "x.scene:1:1: polygon has no 'vertices'; add for example vertices = (0, 0, 3), (1, 0, 3), "
        "(0, 1, 3)");
    CHECK(
        error_of("polygon { vertices = (0, 0, 3), (1, 0, 3) }") ==
        "x.scene:1:11: polygon 1: the polygon has a contour of 2 vertices; give it three or more");
    CHECK(error_of("polygon { vertices = (0, 0, 3), (1, 0, 3), (5, 0, 3) }") ==
          "x.scene:1:11: polygon 1: the polygon's first contour encloses no area: its vertices are "
          "on one "
          "line, or it crosses itself into halves that cancel; move one, or begin with another "
          "contour");
    CHECK(error_of("polygon { vertices = (0, 0, 3), (2, 0, 3), (2, 2, 3), (0, 2, 3.01) }") ==
          "x.scene:1:11: polygon 1: the polygon is not flat: vertex 2 is 0.005 off its plane, and "
          "2.83e-06 is "
          "allowed; move it, or split the polygon into flat ones");
    CHECK(error_of("polygon { vertices = (0, 0), (1, 0), (0, 1) }") ==
          "x.scene:1:22: 'vertices' wants 3 numbers, not 2; write vertices = (0, 0, 3), (1, 0, 3), "
          "(0, 1, 3)");
    CHECK(error_of("polygon { vertices = 7 }") ==
          "x.scene:1:22: 'vertices' wants points in brackets; write vertices = (0, 0, 3), (1, 0, "
          "3), (0, 1, 3)");
    CHECK(error_of(triangle + " checker = (0, 0, 0), (255, 255, 255), 1 }") ==
          "x.scene:1:54: polygon 1: only a plane can have a checker; remove it and use color");

    Object unreal = cube_faces()[0];
    std::get<Polygon>(unreal.surface).contours[0][1].y = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(validate(polygon_scene({unreal})),
                      ContainsSubstring("polygon 1: 'vertices' wants a finite number, not 'nan'"));
    CHECK_THROWS_WITH(validate(polygon_scene({polygon({})})),
                      ContainsSubstring("the polygon has no vertices"));
}

TEST_CASE("a polygon whose corners are rounded to seven digits counts as flat", "[polygons]")
{
    PolygonRandom random(5);
    for (int i = 0; i < 100; ++i) {
        Object object = star();
        const Mat4 m = some_transform(random);
        for (auto& contour : std::get<Polygon>(object.surface).contours)
            for (Vec3& corner : contour)
                for (int axis = 0; axis < 3; ++axis)
                    corner[axis] =
                        static_cast<double>(static_cast<float>((m * glm::dvec4(corner, 1))[axis]));
        CHECK_FALSE(polygon_fault(std::get<Polygon>(object.surface)));
    }
}

TEST_CASE("polygons are packed by their corners in the world", "[polygons]")
{
    PolygonRandom random(61);
    Object object = star();
    object.transform = some_transform(random);
    const LoweredScene lowered = lower(polygon_scene({cube_faces()[0], object}));
    const PackedLists<float> lists(lowered, Listed::all);
    abi::GeometryView<float> view;
    lists.show(view);
    REQUIRE(view.polygons.count == 2);
    const abi::PolygonRecord<float>& record = view.polygons.data[1];
    CHECK(record.corner_count == 17);
    CHECK(record.surface == 1);
    std::size_t at = 0;
    for (const auto& contour : std::get<Polygon>(object.surface).contours) {
        for (std::size_t i = 0; i <= contour.size(); ++i, ++at) {
            const auto& corner = record.corners[at];
            const Vec3 world(object.transform * glm::dvec4(contour[i % contour.size()], 1));
            CHECK(corner.position[1] == static_cast<float>(world.y));
            CHECK(corner.starts_contour == (i == 0 ? 1 : 0));
            CHECK(glm::length(world - Vec3(record.bound[0], record.bound[1], record.bound[2])) <=
                  1.000001 * static_cast<double>(record.bound_radius));
        }
    }
}

TEST_CASE("a coincident copy of a polygon is found", "[polygons]")
{
    Object other = star();
    std::get<Polygon>(other.surface).contours.pop_back();
    LoweredScene lowered = lower(polygon_scene({star(), other, star()}));
    CHECK(remove_duplicates(lowered) == 1);
    REQUIRE(lowered.polygons.size() == 2);
    CHECK(lowered.polygons[1].surface == 1);
}

}  // namespace packtrace::test
