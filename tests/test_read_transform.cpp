#include "catch.hpp"
#include "scene_text.hpp"
#include <packtrace/read_scene.hpp>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <cmath>

// scale, rotate, translate and matrix of objects.
namespace packtrace {

using test::error_of;
using test::parse;

namespace {

Mat4 transform(const std::string& keys)
{
    return parse("ellipsoid { " + keys + " }").objects[0].transform;
}

/// The image of a point under the transform of `keys`.
Vec3 moved(const std::string& keys, const Vec3& point)
{
    return Vec3(transform(keys) * glm::dvec4(point, 1.0));
}

std::string transform_error(const std::string& keys)
{
    return error_of("ellipsoid {\n" + keys + " }");
}

}  // namespace

TEST_CASE("an object without a transform stays where it is", "[read_transform]")
{
    CHECK(transform("") == Mat4(1.0));
}

TEST_CASE("scale takes one factor or one for each axis", "[read_transform]")
{
    CHECK(moved("scale = 2", {1, 2, 3}) == Vec3(2.0, 4.0, 6.0));
    CHECK(moved("scale = (2, -3, 0.5)", {1, 2, 3}) == Vec3(2.0, -6.0, 1.5));
}

TEST_CASE("translate moves by a vector", "[read_transform]")
{
    CHECK(moved("translate = (1, -2, 3)", {1, 1, 1}) == Vec3(2.0, -1.0, 4.0));
}

TEST_CASE("a positive rotation takes x to y, y to z and z to x, exactly", "[read_transform]")
{
    CHECK(moved("rotate = (0, 0, 1, 90)", {1, 0, 0}) == Vec3(0.0, 1.0, 0.0));
    CHECK(moved("rotate = (1, 0, 0, 90)", {0, 1, 0}) == Vec3(0.0, 0.0, 1.0));
    CHECK(moved("rotate = (0, 1, 0, 90)", {0, 0, 1}) == Vec3(1.0, 0.0, 0.0));
    CHECK(moved("rotate = (0, 0, 1, -90)", {1, 0, 0}) == Vec3(0.0, -1.0, 0.0));
    CHECK(moved("rotate = (0, 0, 1, 180)", {1, 0, 0}) == Vec3(-1.0, 0.0, 0.0));
    CHECK(moved("rotate = (0, 0, 1, 270)", {1, 0, 0}) == Vec3(0.0, -1.0, 0.0));
    CHECK(transform("rotate = (0, 0, 1, 720)") == Mat4(1.0));
}

TEST_CASE("an axis of any length turns by the same angle", "[read_transform]")
{
    const Vec3 expected{std::sqrt(0.75), 0.5, 0.0};
    CHECK(glm::length(moved("rotate = (0, 0, 7, 30)", {1, 0, 0}) - expected) < 1e-15);
    CHECK(glm::length(moved("rotate = (0, 0, 1e-200, 30)", {1, 0, 0}) - expected) < 1e-15);
    const Vec3 turned = moved("rotate = (1, 1, 1, 120)", {1, 2, 3});
    CHECK(glm::length(turned - Vec3(3.0, 1.0, 2.0)) < 1e-14);
}

TEST_CASE("a matrix is written as three rows of four", "[read_transform]")
{
    CHECK(moved("matrix = (1, 2, 0, 10,  0, 1, 0, 20,  0, 0, 3, 30)", {1, 1, 1}) ==
          Vec3(13.0, 21.0, 33.0));
    CHECK(transform("matrix = (1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0)") == Mat4(1.0));
}

TEST_CASE("transforms apply in the order written, each as often as it is given", "[read_transform]")
{
    CHECK(moved("scale = 2 translate = (1, 0, 0)", {1, 0, 0}) == Vec3(3.0, 0.0, 0.0));
    CHECK(moved("translate = (1, 0, 0) scale = 2", {1, 0, 0}) == Vec3(4.0, 0.0, 0.0));
    CHECK(moved("translate = (1, 0, 0) rotate = (0, 0, 1, 90) translate = (5, 0, 0)", {1, 0, 0}) ==
          Vec3(5.0, 2.0, 0.0));
}

TEST_CASE("a sphere and a plane keep their own placement beside the transform", "[read_transform]")
{
    const Scene scene = parse(
        "sphere { center = (1, 0, 0) radius = 2 scale = 3 }\n"
        "plane { point = (0, 1, 0) normal = (0, 1, 0) translate = (0, 0, 4) }\n");
    CHECK(std::get<Sphere>(scene.objects[0].surface).center == Vec3(1.0, 0.0, 0.0));
    CHECK(std::get<Sphere>(scene.objects[0].surface).radius == 2.0);
    CHECK(scene.objects[0].transform[0][0] == 3.0);
    CHECK(std::get<Plane>(scene.objects[1].surface).point == Vec3(0.0, 1.0, 0.0));
    CHECK(Vec3(scene.objects[1].transform[3]) == Vec3(0.0, 0.0, 4.0));
}

TEST_CASE("a transform that flattens the object is refused", "[read_transform]")
{
    const std::string cure =
        "ellipsoid 1: the transform is singular, it flattens the object; use factors other than 0 "
        "and columns that are independent";
    CHECK(transform_error("scale = 0") == "x.scene:2:1: " + cure);
    CHECK(transform_error("scale = 2 scale = (1, 0, 1)") == "x.scene:2:11: " + cure);
    CHECK(transform_error("matrix = (1, 2, 3, 0,  4, 5, 6, 0,  7, 8, 9, 0)") ==
          "x.scene:2:1: " + cure);
    CHECK(transform_error("matrix = (0.1, 0.2, 0.3, 0,  0.4, 0.5, 0.6, 0,  0.7, 0.8, 0.9, 0)") ==
          "x.scene:2:1: " + cure);
}

TEST_CASE("strong scales and shears do not count as singular transforms", "[read_transform]")
{
    CHECK(transform("scale = (1e-9, 1, 1e9)")[2][2] == 1e9);
    CHECK(transform("scale = 1e-14")[0][0] == 1e-14);
    CHECK(transform("matrix = (1, 1e6, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0)")[1][0] == 1e6);
    // Its columns are nearly parallel, its rows are not.
    CHECK(transform("matrix = (1e-14, 1e-14, 0, 0,  1, -1, 0, 0,  0, 0, 1, 0)")[0][0] == 1e-14);
}

TEST_CASE("a transform that leaves the range of numbers is refused", "[read_transform]")
{
    const std::string large = ", too large for single precision; use at most 1e+13 in size";
    CHECK(transform_error("scale = 1e200") ==
          "x.scene:2:9: ellipsoid 1: 'scale' is 1e+200" + large);
    CHECK(transform_error("scale = 1e8 scale = 1e8") ==
          "x.scene:2:13: ellipsoid 1: 'matrix' is 1e+16" + large);
    CHECK(transform_error("translate = (6e12, 0, 0) translate = (6e12, 0, 0)") ==
          "x.scene:2:26: ellipsoid 1: 'matrix' is 12000000000000" + large);
    const std::string small =
        "ellipsoid 1: the transform shrinks the object to less than 1e-15 of its size; use factors "
        "nearer to 1";
    CHECK(transform_error("scale = 1e-16") == "x.scene:2:1: " + small);
    CHECK(transform_error("scale = 1e-110") == "x.scene:2:1: " + small);
}

TEST_CASE("a transform of another form is refused", "[read_transform]")
{
    CHECK(transform_error("rotate = (0, 0, 0, 30)") ==
          "x.scene:2:10: 'rotate' has the axis (0, 0, 0), which points nowhere; write (axis x, y, "
          "z, degrees), e.g. rotate = (0, 1, 0, 45)");
    CHECK(transform_error("rotate = 45") ==
          "x.scene:2:10: 'rotate' wants numbers in brackets; write rotate = (0, 1, 0, 45)");
    CHECK(transform_error("scale = (1, 2)") ==
          "x.scene:2:9: 'scale' wants 3 numbers, not 2; write scale = (1, 2, 3)");
    CHECK(transform_error("translate = 5") ==
          "x.scene:2:13: 'translate' wants numbers in brackets; write translate = (0, 1, 2)");
    CHECK(transform_error("matrix = (1, 0, 0)") ==
          "x.scene:2:10: 'matrix' wants 12 numbers, not 3; write matrix = (1, 0, 0, 0, 0, 1, 0, 0, "
          "0, 0, 1, 0)");
}

}  // namespace packtrace
