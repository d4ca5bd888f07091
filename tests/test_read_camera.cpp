#include "catch.hpp"
#include "scene_text.hpp"
#include <packtrace/read_scene.hpp>
#include <packtrace/write_scene.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

// The camera block and the animation.
namespace packtrace {

using test::error_of_line;
using test::parse_with_sphere;

namespace {

Camera camera(const std::string& keys)
{
    return parse_with_sphere("camera { " + keys + " }").camera;
}

std::string camera_error(const std::string& keys)
{
    return error_of_line("camera {\n" + keys + " }");
}

Animation animation(const std::string& text)
{
    return *parse_with_sphere("animation { " + text + " }").animation;
}

std::string animation_error(const std::string& text)
{
    return error_of_line("animation {\n" + text + " }");
}

}  // namespace

TEST_CASE("a camera looks from its position to its target", "[read_camera]")
{
    const Camera read = camera("position = (1, 2, 3) look_at = (6, 2, 3)");
    CHECK(read.position == Vec3(1.0, 2.0, 3.0));
    CHECK(read.rotation[0] == Vec3(0.0, 0.0, -1.0));
    CHECK(read.rotation[1] == Vec3(0.0, 1.0, 0.0));
    CHECK(read.rotation[2] == Vec3(1.0, 0.0, 0.0));
}

TEST_CASE("up turns the camera about its line of sight", "[read_camera]")
{
    const Camera read = camera("look_at = (0, 0, 1) up = (2, 0, 0)");
    CHECK(read.rotation[1] == Vec3(1.0, 0.0, 0.0));
    CHECK(read.rotation[0] == Vec3(0.0, -1.0, 0.0));
}

TEST_CASE("a camera that is only moved looks along z", "[read_camera]")
{
    const Camera read = camera("position = (1, 2, 3)");
    CHECK(read.position == Vec3(1.0, 2.0, 3.0));
    CHECK(read.rotation == Mat3(1.0));
}

TEST_CASE("a rotation is written row by row", "[read_camera]")
{
    // A quarter turn about y: x goes to -z, z goes to x.
    const Camera read = camera("rotation = (0, 0, 1,  0, 1, 0,  -1, 0, 0)");
    CHECK(read.rotation * Vec3(1.0, 0.0, 0.0) == Vec3(0.0, 0.0, -1.0));
    CHECK(read.rotation * Vec3(0.0, 0.0, 1.0) == Vec3(1.0, 0.0, 0.0));
}

TEST_CASE("a rotation rounded to seven digits is accepted", "[read_camera]")
{
    const Camera read =
        camera("rotation = (0.7071068, 0, 0.7071068,  0, 1, 0,  -0.7071068, 0, 0.7071068)");
    CHECK(read.rotation[2][0] == 0.7071068);
}

TEST_CASE("a rotation rounded to four digits is corrected, with one warning", "[read_camera]")
{
    std::vector<std::string> warnings;
    const auto take = [&](const std::string& line) { warnings.push_back(line); };
    const std::string text = std::string(test::any_sphere) +
                             "camera {\n"
                             "  rotation = (0.7071, 0, -0.7071,  0, 1, 0,  0.7071, 0, 0.7071) }\n";
    const Scene read = parse_scene(text, "x.scene", take);
    const Mat3& rotation = read.camera.rotation;
    const Mat3 square = glm::transpose(rotation) * rotation;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) {
            CHECK(std::abs(square[column][row] - (column == row ? 1.0 : 0.0)) < 1e-15);
        }
    CHECK(std::abs(rotation[0][0] - std::sqrt(0.5)) < 1e-15);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0] ==
          "x.scene:3:3: 'rotation' is a rotation only within 2e-05; the nearest one is used; write "
          "its numbers with seven digits or use look_at");
    // The correction does not need a warning handler.
    CHECK(test::parse(text).camera.rotation == rotation);
    // The text written of this scene reads back without a warning.
    CHECK(parse_scene(scene_text(read), "y.scene", take).camera.rotation == rotation);
    CHECK(warnings.size() == 1);
}

TEST_CASE("an angle of view is read in degrees", "[read_camera]")
{
    CHECK(camera("fov = 45").fov == 45.0);
}

TEST_CASE("nine numbers that do not form a rotation are refused", "[read_camera]")
{
    const std::string message =
        "x.scene:3:1: camera: 'rotation' is not a rotation: its rows have to be perpendicular, of "
        "length 1 and unmirrored; correct its numbers or use look_at";
    CHECK(camera_error("rotation = (1, 0, 0,  0, 1, 0,  0, 0, 1.001)") == message);
    CHECK(camera_error("rotation = (1, 0.0011, 0,  0, 1, 0,  0, 0, 1)") == message);
    CHECK(camera_error("rotation = (1, 0, 0,  0, 1, 0,  0, 0, -1)") == message);
    CHECK(camera_error("rotation = (0.71, 0, -0.71,  0, 1, 0,  0.71, 0, 0.71)") == message);
    CHECK(camera_error("rotation = (1, 0, 0,  0, 1, 0)") ==
          "x.scene:3:12: 'rotation' wants 9 numbers, not 6; write rotation = (1, 0, 0, 0, 1, 0, 0, "
          "0, 1)");
}

TEST_CASE("a camera is turned in one way only", "[read_camera]")
{
    CHECK(camera_error("look_at = (0, 0, 1) rotation = (1, 0, 0,  0, 1, 0,  0, 0, 1)") ==
          "x.scene:3:21: 'rotation' and 'look_at' both turn the camera; remove one of them");
    CHECK(camera_error("up = (1, 0, 0)") ==
          "x.scene:3:1: 'up' has no effect without 'look_at'; add look_at or remove it");
    CHECK(error_of_line("camera { }\ncamera { }") ==
          "x.scene:3:1: 'camera' is given twice, first on line 2; remove one of them");
}

TEST_CASE("a camera without a direction is refused", "[read_camera]")
{
    const std::string message =
        "x.scene:3:1: camera: 'look_at' is the camera's own position or straight along 'up'; move "
        "one of "
        "them or give another up";
    CHECK(camera_error("look_at = (0, 0, 0)") == message);
    CHECK(camera_error("look_at = (0, -5, 0)") == message);
    CHECK(camera_error("look_at = (0, 0, 1) up = (0, 0, 2)") == message);
    CHECK(
        camera_error("look_at = (0, 0, 1) up = (0, 0, 0)") ==
        "x.scene:3:26: camera: 'up' is (0, 0, 0), which points nowhere; use a vector of any other "
        "length");
}

TEST_CASE("an angle of view lies between 0 and 180 degrees", "[read_camera]")
{
    CHECK(camera_error("fov = 0") ==
          "x.scene:3:7: camera: 'fov' is 0 degrees; use an angle above 0 and below 180");
    CHECK(camera_error("fov = 180") ==
          "x.scene:3:7: camera: 'fov' is 180 degrees; use an angle above 0 and below 180");
}

TEST_CASE("an orbit has a center, an axis and an angle", "[read_camera]")
{
    const Animation read =
        animation("frames = 120 orbit { center = (0, 0, 3) axis = (0, 0.5, 0.25) degrees = -90 }");
    CHECK(read.frames == 120);
    CHECK(read.keys.empty());
    REQUIRE(read.orbit.has_value());
    CHECK(read.orbit->center == Vec3(0.0, 0.0, 3.0));
    CHECK(read.orbit->axis == Vec3(0.0, 0.5, 0.25));
    CHECK(read.orbit->degrees == -90.0);
}

TEST_CASE("an orbit goes once around the y axis by default", "[read_camera]")
{
    const Animation read = animation("frames = 2 orbit { center = (0, 0, 3) }");
    CHECK(read.orbit->axis == Vec3(0.0, 1.0, 0.0));
    CHECK(read.orbit->degrees == 360.0);
}

TEST_CASE("keys give the camera's pose at frames", "[read_camera]")
{
    const Animation read = animation(
        "frames = 10\n"
        "key { frame = 0 position = (1, 2, 3) look_at = (4, 5, 6) }\n"
        "key { frame = 9 position = (7, 8, 9) look_at = (0, 0, 0) up = (0, 0, 1) }");
    CHECK(read.frames == 10);
    CHECK_FALSE(read.orbit.has_value());
    REQUIRE(read.keys.size() == 2);
    CHECK(read.keys[0].frame == 0);
    CHECK(read.keys[0].position == Vec3(1.0, 2.0, 3.0));
    CHECK(read.keys[0].look_at == Vec3(4.0, 5.0, 6.0));
    CHECK(read.keys[0].up == Vec3(0.0, 1.0, 0.0));
    CHECK(read.keys[1].frame == 9);
    CHECK(read.keys[1].position == Vec3(7.0, 8.0, 9.0));
    CHECK(read.keys[1].look_at == Vec3(0.0, 0.0, 0.0));
    CHECK(read.keys[1].up == Vec3(0.0, 0.0, 1.0));
}

TEST_CASE("an animation moves the camera in one way only", "[read_camera]")
{
    CHECK(animation_error("frames = 10") ==
          "x.scene:2:1: animation: it moves nothing; add orbit { ... } or two or more key { ... }");
    CHECK(animation_error("frames = 10 key { frame = 0 position = (0,0,0) look_at = (0,0,1) }") ==
          "x.scene:2:1: animation: it moves nothing; add orbit { ... } or two or more key { ... }");
    CHECK(animation_error("frames = 10 orbit { center = (0, 0, 3) }\n"
                          "key { frame = 0 position = (0,0,0) look_at = (0,0,1) }") ==
          "x.scene:2:1: animation: it has an orbit and keys, both of which move the camera; remove "
          "one of them");
}

TEST_CASE("an animation's frames are counted from 0 in rising order", "[read_camera]")
{
    const std::string pose = "position = (0, 0, 0) look_at = (0, 0, 1) }\n";
    CHECK(animation_error("orbit { center = (0, 0, 3) }") ==
          "x.scene:2:1: animation has no 'frames'; add for example frames = 120");
    CHECK(animation_error("frames = 0 orbit { center = (0, 0, 3) }") ==
          "x.scene:3:10: animation: 'frames' is 0; use a whole number from 1 to 1000000");
    CHECK(animation_error("frames = 10 key { frame = 10 " + pose) ==
          "x.scene:3:27: key 1: 'frame' is 10; use a whole number from 0 to 9");
    CHECK(
        animation_error("frames = 10 key { frame = 5 " + pose + "key { frame = 5 " + pose) ==
        "x.scene:4:1: key 2: frame 5 does not come after frame 5 of the key before; write keys in "
        "rising order");
}

TEST_CASE("a pose without a direction and an orbit without a radius are refused", "[read_camera]")
{
    CHECK(animation_error("frames = 10 key { frame = 0 position = (0,0,0) look_at = (0,1,0) }") ==
          "x.scene:3:48: key 1: 'look_at' is the camera's own position or straight along 'up'; "
          "move one "
          "of them or give another up");
    const std::string message =
        "x.scene:3:13: orbit: the camera stands on the orbit's axis, where it would not move; give "
        "the "
        "camera another position or the orbit another center";
    CHECK(animation_error("frames = 10 orbit { center = (0, 0, 0) }") == message);
    CHECK(animation_error("frames = 10 orbit { center = (0, 7, 0) }") == message);
    CHECK(animation_error("frames = 10 orbit { center = (0, 0, 3) axis = (0, 0, 1) }") == message);
}

TEST_CASE("an orbit is a block", "[read_camera]")
{
    CHECK(animation_error("frames = 10 orbit = (0, 0, 3)") ==
          "x.scene:3:13: 'orbit' is a block, not a value; write orbit { ... }");
}

}  // namespace packtrace
