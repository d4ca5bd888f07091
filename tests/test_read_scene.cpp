#include <packtrace/read_scene.hpp>

#include <string>

#include "catch.hpp"
#include "scene_text.hpp"

namespace packtrace {

using test::error_of;
using test::error_of_line;
using test::parse;
using test::parse_with_sphere;

TEST_CASE("note 001's scene is read as it stands in the note", "[read_scene]")
{
    const Scene scene = read_scene(PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene");
    CHECK(scene.camera.viewport == Vec2(1.0, 1.0));
    CHECK(scene.camera.distance == 1.0);
    REQUIRE(scene.objects.size() == 4);
    REQUIRE(scene.lights.size() == 3);

    const auto& yellow = scene.objects[3];
    const auto& ground = std::get<Sphere>(yellow.surface);
    CHECK(ground.center == Vec3(0.0, -5001.0, 0.0));
    CHECK(ground.radius == 5000.0);
    CHECK(yellow.name == "sphere 4");
    CHECK(yellow.material.color == Rgb(1.0, 1.0, 0.0));
    const auto& shine = std::get<ScratchMaterial>(yellow.material.model);
    CHECK(shine.specular == 1000.0);
    CHECK(shine.reflective == 0.5);

    CHECK(scene.lights[0].type == LightType::ambient);
    CHECK(scene.lights[0].intensity == Rgb(0.2));
    CHECK(scene.lights[1].type == LightType::point);
    CHECK(scene.lights[1].intensity == Rgb(0.6));
    CHECK(scene.lights[1].vector == Vec3(2.0, 1.0, 0.0));
    CHECK(scene.lights[2].type == LightType::directional);
    CHECK(scene.lights[2].vector == Vec3(1.0, 4.0, 4.0));
}

TEST_CASE("a scene that says little gets the documented defaults", "[read_scene]")
{
    const Scene scene = parse_with_sphere("");
    CHECK(scene.width == 512);
    CHECK(scene.height == 512);
    CHECK(scene.illumination == Illumination::scratch);
    CHECK(scene.max_depth == 3);
    CHECK(scene.shadows == ShadowKind::opaque);
    CHECK(scene.background == Rgb(0.0));
    CHECK(scene.camera.pixel_sample == Vec2(0.0, 1.0));
    CHECK(scene.camera.rotation == Mat3(1.0));
    CHECK(scene.objects[0].material.color == Rgb(1.0));
    CHECK(std::get<ScratchMaterial>(scene.objects[0].material.model).specular == -1.0);
    CHECK_FALSE(scene.animation.has_value());
}

TEST_CASE("the scene's own keys are read", "[read_scene]")
{
    const Scene scene = parse_with_sphere(
        "viewport_size = 1.5 x 1  projection_plane_d = 2\n"
        "image_size = 640x480  background = (51, 0, 255)\n"
        "max_depth = 7  shadows = none  pixel_sample = (0.25, 0.75)\n");
    CHECK(scene.camera.viewport == Vec2(1.5, 1.0));
    CHECK(scene.camera.distance == 2.0);
    CHECK(scene.width == 640);
    CHECK(scene.height == 480);
    CHECK(scene.background == Rgb(0.2, 0.0, 1.0));
    CHECK(scene.max_depth == 7);
    CHECK(scene.shadows == ShadowKind::none);
    CHECK(scene.camera.pixel_sample == Vec2(0.25, 0.75));
}

TEST_CASE("a plane's normal is made unit and its checker gives both colours", "[read_scene]")
{
    const Scene scene = parse(
        "plane { point = (0, -1, 0) normal = (0, 2, 0)\n"
        "        checker = (255, 255, 255), rgb(0.25, 0.5, 0.75), 2.5 }");
    const auto& plane = std::get<Plane>(scene.objects[0].surface);
    CHECK(plane.point == Vec3(0.0, -1.0, 0.0));
    CHECK(plane.normal == Vec3(0.0, 1.0, 0.0));
    CHECK(plane.u == Vec3(1.0, 0.0, 0.0));
    CHECK(scene.objects[0].name == "plane 1");
    const Material& material = scene.objects[0].material;
    CHECK(material.color == Rgb(1.0));
    REQUIRE(material.checker.has_value());
    CHECK(material.checker->other == Rgb(0.25, 0.5, 0.75));
    CHECK(material.checker->size == 2.5);
}

TEST_CASE("an unknown material is named with its place and the cure", "[read_scene]")
{
    CHECK(error_of_line("sphere { center = (0, 0, 3) radius = 1 material = gold }") ==
          "x.scene:2:51: unknown material 'gold'; define it with: material gold { ... }");
}

TEST_CASE("a missing radius is named", "[read_scene]")
{
    CHECK(error_of("sphere { center = (0, 0, 3) }") ==
          "x.scene:1:1: sphere has no 'radius'; add for example radius = 1");
}

}  // namespace packtrace
