#include "catch.hpp"
#include "scene_text.hpp"
#include <packtrace/read_scene.hpp>
#include <packtrace/write_scene.hpp>

// Spheres, planes and quadrics with their own keys, and objects' names.
namespace packtrace {

using test::error_of;
using test::error_of_line;
using test::parse;

namespace {

Quadric quadric(const std::string& text)
{
    return std::get<Quadric>(parse(text).objects[0].surface);
}

void check_kind(const std::string& keyword, QuadricKind kind,
                const std::array<double, 10>& coefficients)
{
    CAPTURE(keyword);
    const Scene scene = parse(keyword + " { }");
    const auto& surface = std::get<Quadric>(scene.objects[0].surface);
    CHECK(surface.kind == kind);
    CHECK(surface.coefficients == coefficients);
    CHECK_FALSE(surface.z_range.has_value());
    CHECK_FALSE(surface.capped);
    CHECK(scene.objects[0].name == keyword + " 1");
}

}  // namespace

TEST_CASE("a sphere has a center and a radius", "[read_surface]")
{
    const Scene scene = parse("sphere { center = (1, -2, 3.5) radius = 0.25 }");
    CHECK(std::get<Sphere>(scene.objects[0].surface).center == Vec3(1.0, -2.0, 3.5));
    CHECK(std::get<Sphere>(scene.objects[0].surface).radius == 0.25);
}

TEST_CASE("a plane's normal is made unit and its checker's axes are laid", "[read_surface]")
{
    const Scene scene = parse("plane { point = (0, -1, 0) normal = (0, 2, 0) }");
    const auto& plane = std::get<Plane>(scene.objects[0].surface);
    CHECK(plane.point == Vec3(0.0, -1.0, 0.0));
    CHECK(plane.normal == Vec3(0.0, 1.0, 0.0));
    CHECK(plane.u == Vec3(1.0, 0.0, 0.0));
    CHECK(plane.v == Vec3(0.0, 0.0, 1.0));
}

TEST_CASE("a normal's length neither over- nor underflows", "[read_surface]")
{
    for (const char* normal : {"(0, 0, 1e300)", "(0, 0, 1e-300)"}) {
        const Scene scene =
            parse(std::string("plane { point = (0, 0, 0) normal = ") + normal + " }");
        CHECK(std::get<Plane>(scene.objects[0].surface).normal == Vec3(0.0, 0.0, 1.0));
    }
}

TEST_CASE("each named quadric has its equation's coefficients", "[read_surface]")
{
    check_kind("ellipsoid", QuadricKind::ellipsoid, {1, 1, 1, 0, 0, 0, 0, 0, 0, -1});
    check_kind("cylinder", QuadricKind::cylinder, {1, 1, 0, 0, 0, 0, 0, 0, 0, -1});
    check_kind("cone", QuadricKind::cone, {1, 1, -1, 0, 0, 0, 0, 0, 0, 0});
    check_kind("paraboloid", QuadricKind::paraboloid, {1, 1, 0, 0, 0, 0, 0, 0, -1, 0});
    check_kind("hyperboloid", QuadricKind::hyperboloid, {1, 1, -1, 0, 0, 0, 0, 0, 0, -1});
    check_kind("hyperboloid2", QuadricKind::hyperboloid2, {1, 1, -1, 0, 0, 0, 0, 0, 0, 1});
    check_kind("saddle", QuadricKind::saddle, {1, -1, 0, 0, 0, 0, 0, 0, -1, 0});
}

TEST_CASE("a quadric takes its ten coefficients in order", "[read_surface]")
{
    const Quadric surface = quadric("quadric { coefficients = (1,2,3, 4,5,6, 7,8,9, -10) }");
    CHECK(surface.kind == QuadricKind::general);
    CHECK(surface.coefficients == std::array<double, 10>{1, 2, 3, 4, 5, 6, 7, 8, 9, -10});
}

TEST_CASE("z_range clips a quadric and capped closes it", "[read_surface]")
{
    const Quadric open = quadric("cone { z_range = (-1, 0.5) }");
    REQUIRE(open.z_range.has_value());
    CHECK(open.z_range->low == -1.0);
    CHECK(open.z_range->high == 0.5);
    CHECK_FALSE(open.capped);
    CHECK(quadric("cylinder { capped = true z_range = (0, 1) }").capped);
    CHECK_FALSE(quadric("cylinder { capped = false z_range = (0, 1) }").capped);
    CHECK(quadric("quadric { coefficients = (1,1,1,0,0,0,0,0,0,-1) capped = true "
                  "z_range = (0, 1) }")
              .capped);
}

TEST_CASE("objects without a name are counted by their kind", "[read_surface]")
{
    const Scene scene = parse(
        "sphere { center = (0, 0, 0) radius = 1 }\ncone { }\n"
        "sphere { center = (0, 0, 0) radius = 1 name = \"the big one\" }\n"
        "sphere { center = (0, 0, 0) radius = 1 }\ncone { name = hat }\n");
    REQUIRE(scene.objects.size() == 5);
    CHECK(scene.objects[0].name == "sphere 1");
    CHECK(scene.objects[1].name == "cone 1");
    CHECK(scene.objects[2].name == "the big one");
    CHECK(scene.objects[3].name == "sphere 2");
    CHECK(scene.objects[4].name == "hat");
}

TEST_CASE("a name of two objects causes a warning", "[read_surface]")
{
    const auto warning = [](const std::string& text) {
        std::string lines;
        const Scene scene =
            parse_scene(text, "x.scene", [&](const std::string& line) { lines += line; });
        CHECK(test::parse(scene_text(scene)).objects[1].name == scene.objects[1].name);
        return lines;
    };
    CHECK(warning("cone { name = hat }\ncylinder { name = \"hat\" }") ==
          "x.scene:2:19: duplicate name 'hat', that of the object on line 1 too; give one of them "
          "another name");
    CHECK(warning("cone { name = \"cone 1\" }\ncone { }") ==
          "x.scene:2:1: duplicate name 'cone 1', that of the object on line 1 too; give one of "
          "them another name");
    CHECK(warning("cone { name = hat }\ncone { }\ncone { }") == "");
    CHECK(error_of("cone { name = \"\" }") ==
          "x.scene:1:15: the name is empty; write one or remove the key");
}

TEST_CASE("a surface without its keys is refused with an example", "[read_surface]")
{
    CHECK(error_of("sphere { center = (0, 0, 3) }") ==
          "x.scene:1:1: sphere has no 'radius'; add for example radius = 1");
    CHECK(error_of("sphere { radius = 1 }") ==
          "x.scene:1:1: sphere has no 'center'; add for example center = (0, 0, 3)");
    CHECK(error_of("plane { normal = (0, 1, 0) }") ==
          "x.scene:1:1: plane has no 'point'; add for example point = (0, -1, 0)");
    CHECK(error_of("plane { point = (0, 1, 0) }") ==
          "x.scene:1:1: plane has no 'normal'; add for example normal = (0, 1, 0)");
    CHECK(error_of("quadric { }") ==
          "x.scene:1:1: quadric has no 'coefficients'; add for example coefficients = (1, 1, 1, 0, "
          "0, 0, 0, 0, 0, -1)");
}

TEST_CASE("a radius is above 0", "[read_surface]")
{
    CHECK(error_of("sphere { center = (0, 0, 3) radius = -1 }") ==
          "x.scene:1:38: sphere 1: 'radius' is -1; use a number above 0");
    CHECK(error_of("sphere { center = (0, 0, 3) radius = 0 }") ==
          "x.scene:1:38: sphere 1: 'radius' is 0; use a number above 0");
}

TEST_CASE("a normal has a direction", "[read_surface]")
{
    CHECK(error_of("plane { point = (0, 0, 0) normal = (0, -0, 0) }") ==
          "x.scene:1:36: plane 1: 'normal' is (0, 0, 0), which points nowhere; use a vector of any "
          "other "
          "length");
}

TEST_CASE("an invalid z_range, and a cap without a z_range, are refused", "[read_surface]")
{
    CHECK(error_of("cone { z_range = (1, -0.5) }") ==
          "x.scene:1:18: cone 1: 'z_range' is (1, -0.5), upside down or empty; write the lower end "
          "first, "
          "then a higher one");
    CHECK(error_of("cone { z_range = (1, 1) }") ==
          "x.scene:1:18: cone 1: 'z_range' is (1, 1), upside down or empty; write the lower end "
          "first, "
          "then a higher one");
    CHECK(error_of("cone { capped = true }") ==
          "x.scene:1:8: cone 1: 'capped' closes the ends of a z_range, and there is none; add for "
          "example "
          "z_range = (-1, 1) or remove it");
    CHECK(error_of("cone { capped = maybe z_range = (0, 1) }") ==
          "x.scene:1:17: unknown capped 'maybe'; use one of: no, yes, false, true");
}

TEST_CASE("a clip that leaves nothing of a surface causes one warning", "[read_surface]")
{
    const auto warnings_of = [](const std::string& text) {
        std::vector<std::string> warnings;
        (void)parse_scene(text, "x.scene",
                          [&](const std::string& line) { warnings.push_back(line); });
        return warnings;
    };
    const std::vector<std::string> one = warnings_of(
        "sphere { center = (0, 0, 3) radius = 1 }\n"
        "paraboloid { z_range = (-2, -1) }\n"
        "ellipsoid { z_range = (2, 3)  capped = yes }\n");
    REQUIRE(one.size() == 1);
    CHECK(one[0] ==
          "x.scene:2:14: 'z_range' leaves nothing of the surface, which has no point at these "
          "heights of its own space; give others (and so of 1 more)");
    CHECK(warnings_of("hyperboloid2 { z_range = (-0.5, 0.5) }\n").size() == 1);
    for (const char* rest :
         {"hyperboloid2 { z_range = (-2, 0.5) }\n", "cone { z_range = (1, 2) }\n",
          "paraboloid { z_range = (-2, 0) }\n", "saddle { z_range = (5, 6) }\n",
          "ellipsoid { z_range = (-3, 3) }\n", "hyperboloid { z_range = (0, 1) }\n"})
        CHECK(warnings_of(rest).empty());
}

TEST_CASE("a key of another surface is refused", "[read_surface]")
{
    CHECK(error_of("cone { radius = 1 }") ==
          "x.scene:1:8: unknown key 'radius' in cone; use one of: z_range, capped, color, "
          "specular, reflective, name, material, checker, casts_shadow, scale, rotate, translate, "
          "matrix");
    CHECK(error_of_line("sphere { centre = (0, 0, 3) radius = 1 }") ==
          "x.scene:2:10: unknown key 'centre' in sphere; did you mean 'center'?");
    CHECK(error_of_line("quadric { coefficients = (1, 2, 3) }") ==
          "x.scene:2:26: 'coefficients' wants 10 numbers, not 3; write coefficients = (1, 1, 1, 0, "
          "0, 0, 0, 0, 0, -1)");
}

}  // namespace packtrace
