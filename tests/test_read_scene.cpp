#include "catch.hpp"
#include "scene/language/rows.hpp"
#include "scene_text.hpp"
#include <packtrace/read_scene.hpp>

#include <fstream>
#include <string>

// Valid scene files: the scene's own keys, lights and the syntax.
namespace packtrace {

using test::any_sphere;
using test::parse;
using test::parse_with_sphere;

namespace {

const char* const four_spheres = PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene";

void check_ball(const Object& object, const Vec3& center, const Rgb& color, double specular,
                double reflective)
{
    CAPTURE(object.name);
    CHECK(std::get<Sphere>(object.surface).center == center);
    CHECK(std::get<Sphere>(object.surface).radius == 1.0);
    CHECK(object.material.color == color);
    CHECK(std::get<ScratchMaterial>(object.material.model).specular == specular);
    CHECK(std::get<ScratchMaterial>(object.material.model).reflective == reflective);
    CHECK(object.transform == Mat4(1.0));
}

}  // namespace

TEST_CASE("note 001's scene is read: its four spheres", "[read_scene]")
{
    const Scene scene = read_scene(four_spheres);
    CHECK(scene.camera.viewport == Vec2(1.0, 1.0));
    CHECK(scene.camera.distance == 1.0);
    REQUIRE(scene.objects.size() == 4);
    check_ball(scene.objects[0], {0, -1, 3}, {1, 0, 0}, 500, 0.2);
    check_ball(scene.objects[1], {-2, 1, 3}, {0, 0, 1}, 500, 0.3);
    check_ball(scene.objects[2], {2, 1, 3}, {0, 1, 0}, 10, 0.4);
    const Object& yellow = scene.objects[3];
    CHECK(std::get<Sphere>(yellow.surface).center == Vec3(0.0, -5001.0, 0.0));
    CHECK(std::get<Sphere>(yellow.surface).radius == 5000.0);
    CHECK(yellow.material.color == Rgb(1.0, 1.0, 0.0));
    CHECK(std::get<ScratchMaterial>(yellow.material.model).specular == 1000.0);
    CHECK(std::get<ScratchMaterial>(yellow.material.model).reflective == 0.5);
}

TEST_CASE("note 001's scene is read: its three lights", "[read_scene]")
{
    const Scene scene = read_scene(four_spheres);
    REQUIRE(scene.lights.size() == 3);
    CHECK(scene.lights[0].type == LightType::ambient);
    CHECK(scene.lights[0].intensity == Rgb(0.2));
    CHECK(scene.lights[1].type == LightType::point);
    CHECK(scene.lights[1].intensity == Rgb(0.6));
    CHECK(scene.lights[1].vector == Vec3(2.0, 1.0, 0.0));
    CHECK(scene.lights[2].type == LightType::directional);
    CHECK(scene.lights[2].intensity == Rgb(0.2));
    CHECK(scene.lights[2].vector == Vec3(1.0, 4.0, 4.0));
}

TEST_CASE("a scene with few keys gets the documented defaults", "[read_scene]")
{
    const Scene scene = parse_with_sphere("");
    CHECK(scene.width == 512);
    CHECK(scene.height == 512);
    CHECK(scene.background == Rgb(0.0));
    CHECK(scene.illumination == Illumination::scratch);
    CHECK(scene.max_depth == 3);
    CHECK(scene.shadows == ShadowKind::opaque);
    CHECK(scene.camera.viewport == Vec2(1.0, 1.0));
    CHECK(scene.camera.distance == 1.0);
    CHECK(scene.camera.position == Vec3(0.0));
    CHECK(scene.camera.rotation == Mat3(1.0));
    CHECK_FALSE(scene.camera.fov.has_value());
    CHECK(scene.lights.empty());
    CHECK_FALSE(scene.animation.has_value());
}

TEST_CASE("the scene's own keys are read", "[read_scene]")
{
    const Scene scene = parse_with_sphere(
        "viewport_size = 1.5 x 1  projection_plane_d = 2\n"
        "image_size = 640 x 480  background = (51, 0, 255)\n"
        "max_depth = 7  shadows = none\n");
    CHECK(scene.camera.viewport == Vec2(1.5, 1.0));
    CHECK(scene.camera.distance == 2.0);
    CHECK(scene.width == 640);
    CHECK(scene.height == 480);
    CHECK(scene.background == Rgb(0.2, 0.0, 1.0));
    CHECK(scene.max_depth == 7);
    CHECK(scene.shadows == ShadowKind::none);
}

TEST_CASE("each kind of shadow is read", "[read_scene]")
{
    CHECK(parse_with_sphere("shadows = opaque").shadows == ShadowKind::opaque);
    CHECK(parse_with_sphere("shadows = transparent").shadows == ShadowKind::transparent);
    CHECK(parse_with_sphere("shadows = none").shadows == ShadowKind::none);
}

TEST_CASE("each illumination is read", "[read_scene]")
{
    const auto illumination = [](const std::string& name) {
        return parse_with_sphere("illumination = " + name).illumination;
    };
    CHECK(illumination("scratch") == Illumination::scratch);
    CHECK(illumination("sketch") == Illumination::sketch);
    CHECK(illumination("whitted") == Illumination::whitted);
    CHECK(illumination("shader") == Illumination::shader);
    CHECK(illumination("general") == Illumination::general);
}

TEST_CASE("the general model's rule at the depth limit is read", "[read_scene]")
{
    const std::string general = "illumination = general ";
    CHECK(parse_with_sphere(general).depth_limit == DepthLimit::local);
    CHECK(parse_with_sphere(general + "depth_limit = local").depth_limit == DepthLimit::local);
    CHECK(parse_with_sphere(general + "depth_limit = background").depth_limit ==
          DepthLimit::background);
}

TEST_CASE("the sample is at the pixel's corner for scratch, else at its centre", "[read_scene]")
{
    CHECK(parse_with_sphere("").camera.pixel_sample == Vec2(0.0, 1.0));
    CHECK(parse_with_sphere("illumination = sketch").camera.pixel_sample == Vec2(0.5, 0.5));
    CHECK(parse_with_sphere("illumination = general").camera.pixel_sample == Vec2(0.5, 0.5));
    CHECK(parse_with_sphere("pixel_sample = (0.25, 0.75)").camera.pixel_sample == Vec2(0.25, 0.75));
    CHECK(parse_with_sphere("illumination = sketch pixel_sample = (0, 1)").camera.pixel_sample ==
          Vec2(0.0, 1.0));
}

TEST_CASE("a light's intensity is a factor, one or three", "[read_scene]")
{
    const Scene scene = parse_with_sphere(
        "light { type = ambient intensity = 0.6 }\n"
        "light { type = ambient intensity = (1, 2.5, 0) }\n"
        "light { type = ambient intensity = rgb(1, 0.5, 0) }\n");
    REQUIRE(scene.lights.size() == 3);
    CHECK(scene.lights[0].intensity == Rgb(0.6));
    CHECK(scene.lights[1].intensity == Rgb(1.0, 2.5, 0.0));
    CHECK(scene.lights[2].intensity == Rgb(1.0, 0.5, 0.0));
}

TEST_CASE("a colour is written in 0 to 255 or as rgb in 0 to 1", "[read_scene]")
{
    CHECK(parse_with_sphere("background = (51, 102, 255)").background == Rgb(0.2, 0.4, 1.0));
    CHECK(parse_with_sphere("background = rgb(0.25, 0.5, 1)").background == Rgb(0.25, 0.5, 1.0));
}

TEST_CASE("comments may stand anywhere between words", "[read_scene]")
{
    const Scene scene = parse(
        "# first\nsphere # a ball { }\n{ # open\ncenter # where\n= # there\n( 1 # x\n, 2 # y\n"
        ", 3 # z\n) # done\nradius = 4 # big }\n}# end");
    const auto& sphere = std::get<Sphere>(scene.objects[0].surface);
    CHECK(sphere.center == Vec3(1.0, 2.0, 3.0));
    CHECK(sphere.radius == 4.0);
}

TEST_CASE("blanks around a value's signs may be left out or put in", "[read_scene]")
{
    const Scene tight = parse("image_size=640x480 sphere{center=(1,2,3)radius=4}");
    const Scene wide = parse(
        "image_size =\t640\nx 480\r\nsphere { center = ( 1 , 2 ,3 )\n"
        "radius\n=\n4 }\r\n");
    for (const Scene& scene : {tight, wide}) {
        CHECK(scene.width == 640);
        CHECK(scene.height == 480);
        CHECK(std::get<Sphere>(scene.objects[0].surface).center == Vec3(1.0, 2.0, 3.0));
        CHECK(std::get<Sphere>(scene.objects[0].surface).radius == 4.0);
    }
}

TEST_CASE("numbers are written with sign, point and exponent", "[read_scene]")
{
    const Scene scene = parse("sphere { center = (+1.5, -.25, 2.) radius = 12.5e-1 }");
    const auto& sphere = std::get<Sphere>(scene.objects[0].surface);
    CHECK(sphere.center == Vec3(1.5, -0.25, 2.0));
    CHECK(sphere.radius == 1.25);
}

TEST_CASE("a byte order mark before the text is skipped", "[read_scene]")
{
    CHECK(parse(std::string("\xEF\xBB\xBF") + any_sphere).objects.size() == 1);
}

TEST_CASE("the last line needs no end, and letters outside ASCII are fine in names and comments",
          "[read_scene]")
{
    const Scene scene =
        parse("sphere { center = (0, 0, 3) radius = 1 name = \"Kügelchen\" } # größer");
    CHECK(scene.objects[0].name == "Kügelchen");
}

TEST_CASE("objects and lights keep the file's order", "[read_scene]")
{
    const Scene scene = parse_with_sphere(
        "light { type = point intensity = 1 position = (1, 0, 0) }\n"
        "plane { point = (0, -1, 0) normal = (0, 1, 0) }\n"
        "light { type = ambient intensity = 1 }\n"
        "sphere { center = (9, 0, 0) radius = 1 }\n");
    REQUIRE(scene.objects.size() == 3);
    CHECK(std::holds_alternative<Sphere>(scene.objects[0].surface));
    CHECK(std::holds_alternative<Plane>(scene.objects[1].surface));
    CHECK(std::get<Sphere>(scene.objects[2].surface).center == Vec3(9.0, 0.0, 0.0));
    REQUIRE(scene.lights.size() == 2);
    CHECK(scene.lights[0].type == LightType::point);
    CHECK(scene.lights[1].type == LightType::ambient);
}

TEST_CASE("every example of the language's reference is read", "[read_scene]")
{
    const std::vector<std::string> examples = test::scene_examples();
    for (const std::string& text : examples) {
        CAPTURE(text);
        CHECK_FALSE(parse(text).objects.empty());
    }
    CHECK(examples.size() >= 10);
}

TEST_CASE("the tables of the language's reference have the program's rows", "[read_scene]")
{
    for (const std::string_view name : language::key_table_names()) {
        INFO("table " << name << "; docs/write_tables.sh writes it anew");
        std::ifstream reference(PACKTRACE_SOURCE_DIR "/docs/scene.md");
        const std::string mark = "<!-- keys: " + std::string(name) + " -->";
        std::string line;
        while (std::getline(reference, line) && line != mark) {
        }
        std::string table;
        while (std::getline(reference, line) && line.starts_with('|'))
            table += line + '\n';
        CHECK(table == language::key_table(name));
    }
}

}  // namespace packtrace
