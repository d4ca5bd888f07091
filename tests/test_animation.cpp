// The camera of each frame, the names of frames, and the bytes of a video.
#include "catch.hpp"
#include "image/y4m.hpp"
#include "refusal.hpp"
#include "render/frame_numbers.hpp"
#include "scene_text.hpp"
#include <packtrace/animate.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace packtrace::test {
namespace {

void check_near(const Vec3& got, const Vec3& expected, double margin = 1e-12)
{
    CAPTURE(got.x, got.y, got.z, expected.x, expected.y, expected.z);
    CHECK(glm::length(got - expected) <= margin);
}

Vec3 at(const Scene& scene, int frame)
{
    return camera_at(scene, frame).position;
}

const char* const four_keys =
    "animation { frames = 61\n"
    "key { frame = 5   position = (0, 0, -5)  look_at = (0, 0, 3) }\n"
    "key { frame = 15  position = (2, 1, -4)  look_at = (0, 0, 3) }\n"
    "key { frame = 40  position = (1, 3, 0)   look_at = (1, 0, 4) }\n"
    "key { frame = 50  position = (0, 4, 1)   look_at = (0, 0, 3)  up = (0, 0, 1) } }\n";

}  // namespace

TEST_CASE("an orbit of four frames stops at the quarters of its circle", "[animation]")
{
    const Scene scene = parse_with_sphere(
        "camera { position = (0, 1, -2)  look_at = (0, 1, 3) }\n"
        "animation { frames = 4  orbit { center = (0, 1, 3)  axis = (0, 2, 0) } }");
    // A positive rotation about y takes z to x, as `rotate` does.
    const std::vector<Vec3> stops = {{0, 1, -2}, {-5, 1, 3}, {0, 1, 8}, {5, 1, 3}};
    for (int frame = 0; frame < 4; ++frame) {
        CAPTURE(frame);
        const Camera camera = camera_at(scene, frame);
        const Vec3 stop = stops[static_cast<std::size_t>(frame)];
        check_near(camera.position, stop);
        check_near(camera.rotation[2], (Vec3(0, 1, 3) - stop) / 5.0);
        check_near(camera.rotation[1], {0, 1, 0});
    }
}

TEST_CASE("an orbit starts with the scene's own pose, tilted or not", "[animation]")
{
    const Scene scene = parse_with_sphere(
        "camera { position = (1, 2, -3)  look_at = (0, 0.5, 2)  up = (0.4, 1, 0.1)  fov = 33 }\n"
        "animation { frames = 7  orbit { center = (0, 0.5, 2)  degrees = -90 } }");
    const Camera start = camera_at(scene, 0);
    check_near(start.position, scene.camera.position);
    for (int axis = 0; axis < 3; ++axis)
        check_near(start.rotation[axis], scene.camera.rotation[axis]);
    CHECK(start.fov == scene.camera.fov);
    // The rotation stays orthonormal, and the camera stays at the same height above the centre.
    const Camera end = camera_at(scene, 6);
    CHECK(glm::dot(glm::cross(end.rotation[0], end.rotation[1]), end.rotation[2]) == Approx(1.0));
    CHECK(end.position.y == Approx(2.0));
}

TEST_CASE("an orbit of a camera that looks away turns it to the centre", "[animation]")
{
    const Scene scene = parse_with_sphere(
        "camera { position = (0, 5, 3)  look_at = (0, 5, 9) }\n"
        "animation { frames = 2  orbit { center = (0, 0, 3)  axis = (1, 0, 0) } }");
    check_near(camera_at(scene, 0).rotation[2], {0, -1, 0});
    check_near(camera_at(scene, 1).position, {0, -5, 3});
}

TEST_CASE("the camera passes through every key and rests outside of them", "[animation]")
{
    const Scene scene = parse_with_sphere(four_keys);
    for (const CameraKey& key : scene.animation->keys) {
        CAPTURE(key.frame);
        const Camera camera = camera_at(scene, key.frame);
        CHECK(camera.position == key.position);
        CHECK(camera.rotation == look_at(key.position, key.look_at, key.up));
    }
    CHECK(at(scene, 0) == at(scene, 5));
    CHECK(at(scene, 60) == at(scene, 50));
}

TEST_CASE("two keys give a straight line at an even pace", "[animation]")
{
    const Scene scene = parse_with_sphere(
        "animation { frames = 9\n"
        "key { frame = 0  position = (0, 0, 0)   look_at = (0, 0, 3) }\n"
        "key { frame = 8  position = (8, 4, -2)  look_at = (8, 4, 1) } }");
    for (int frame = 0; frame <= 8; ++frame)
        check_near(at(scene, frame), Vec3(1.0, 0.5, -0.25) * static_cast<double>(frame));
    check_near(camera_at(scene, 3).rotation[2], {0, 0, 1});
}

TEST_CASE("between keys the camera's speed changes nowhere by a jump", "[animation]")
{
    const Scene scene = parse_with_sphere(four_keys);
    double fastest = 0.0;
    double largest_jump = 0.0;
    for (int frame = 6; frame < 49; ++frame) {
        const Vec3 before = at(scene, frame) - at(scene, frame - 1);
        const Vec3 after = at(scene, frame + 1) - at(scene, frame);
        fastest = std::max(fastest, glm::length(after));
        largest_jump = std::max(largest_jump, glm::length(after - before));
    }
    // Straight lines between the keys would jump by 0.26 of 0.25.
    CHECK(fastest > 0.1);
    CHECK(largest_jump < 0.15 * fastest);
}

TEST_CASE("poses that can't be had are refused", "[animation]")
{
    const Scene still = parse(any_sphere);
    CHECK(refusal([&] { return camera_at(still, 0); }) == "the scene has no animation");
    const Scene scene = parse_with_sphere(four_keys);
    for (const int frame : {-1, 61})
        CHECK(refusal([&] { return camera_at(scene, frame); }) ==
              "frame " + std::to_string(frame) + " is none of the animation's, 0..60");
    const Scene through = parse_with_sphere(
        "animation { frames = 3\n"
        "key { frame = 0  position = (0, 0, 0)  look_at = (0, 0, 3) }\n"
        "key { frame = 2  position = (0, 0, 6)  look_at = (0, 0, 3) } }");
    CHECK_THAT(refusal([&] { return camera_at(through, 1); }),
               ContainsSubstring("frame 1: the way between the camera's keys leads through"));
    // Made in code, where no reader has looked at them.
    Scene made = still;
    made.animation = Animation{};
    made.animation->frames = 10;
    CHECK_THAT(refusal([&] { return camera_at(made, 0); }),
               ContainsSubstring("animation: it moves nothing"));
    made.animation->orbit = Orbit{};
    made.animation->orbit->axis = Vec3(0.0);
    CHECK_THAT(refusal([&] { return camera_at(made, 0); }), ContainsSubstring("orbit: "));
    made.animation->orbit.reset();
    made.animation->keys = scene.animation->keys;
    std::swap(made.animation->keys[0].frame, made.animation->keys[1].frame);
    CHECK_THAT(refusal([&] { return camera_at(made, 0); }), ContainsSubstring("key "));
}

TEST_CASE("a pattern names frames by its one place for the number", "[animation]")
{
    CHECK(FramePattern("out/frame_%04d.png").name(7) == "out/frame_0007.png");
    CHECK(FramePattern("%d.png").name(120) == "120.png");
    CHECK(FramePattern("%02d.png").name(12345) == "12345.png");
    CHECK(FramePattern("100%%/%03d%%.pfm").name(9) == "100%/009%.pfm");
}

TEST_CASE("patterns without exactly one place are refused", "[animation]")
{
    const auto message = [](const char* text) {
        return refusal([&] { return FramePattern(text).name(0); });
    };
    for (const char* text : {"frame.png", "", "100%%.png"})
        CHECK_THAT(message(text), ContainsSubstring("has no place for the frame's number"));
    for (const char* text : {"%d_%d.png", "%03d%04d.png"})
        CHECK_THAT(message(text), ContainsSubstring("has two places for the frame's number"));
    for (const char* text : {"%s.png", "%4d.png", "%0d.png", "%", "%0", "%04", "%012d", "%d%"})
        CHECK_THAT(message(text), ContainsSubstring("has a % that is no %d, %0Nd or %%"));
}

TEST_CASE("ranges of frames are two numbers in order", "[animation]")
{
    const FrameRange range = parse_frame_range("3..11");
    CHECK(range.first == 3);
    CHECK(range.last == 11);
    CHECK(range.count() == 9);
    CHECK(parse_frame_range("5..5").count() == 1);
    for (const char* text : {"", "5", "..", "1..", "..4", "-1..4", "1...4", "1..4x", "a..b", "1-4"})
        CHECK_THAT(refusal([&] { return parse_frame_range(text).count(); }),
                   ContainsSubstring("is not a range of frames such as 0..119"));
    CHECK_THAT(refusal([] { return parse_frame_range("4..1").count(); }),
               ContainsSubstring("ends before it begins"));
    CHECK_NOTHROW(check_frame_range({0, 9}, 10));
    CHECK_THROWS_AS(check_frame_range({0, 10}, 10), std::invalid_argument);
}

TEST_CASE("frame rates are whole numbers, decimals or fractions, written in lowest terms",
          "[animation]")
{
    const auto header_of = [](const char* text) {
        const std::optional<FrameRate> rate = parse_frame_rate(text);
        return rate ? std::to_string(rate->frames) + ":" + std::to_string(rate->seconds) : "none";
    };
    CHECK(header_of("24") == "24:1");
    CHECK(header_of("23.976") == "2997:125");
    CHECK(header_of("30000/1001") == "30000:1001");
    CHECK(header_of("12.50") == "25:2");
    CHECK(header_of("1/60") == "1:60");
    CHECK(header_of("2000/2") == "1000:1");
    CHECK(header_of("1000.000001") == "none");
    for (const char* text : {"", "0", "0.0", "0/1", "1/0", "1001", "-1", "+1", "1e1", "24.", ".5",
                             "1/", "/1", "1.5/2", "1/2/3", "24 ", "nan", "1234567890", "1/-2"}) {
        CAPTURE(text);
        CHECK(header_of(text) == "none");
    }
}

TEST_CASE("a video is a header and three whole planes a frame", "[animation]")
{
    CHECK(y4m_header(5, 3, {24, 1}) == "YUV4MPEG2 W5 H3 F24:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n");
    Image<float> image(6, 1);
    // White, black, red, green, blue, and beyond white.
    image.rgb = {1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 7, 7, 7};
    const Bytes frame = y4m_frame(image);
    const std::string text(frame.begin(), frame.begin() + 6);
    CHECK(text == "FRAME\n");
    const Bytes planes(frame.begin() + 6, frame.end());
    CHECK((planes == Bytes{235, 16, 82, 144, 41, 235,       // Y
                           128, 128, 90, 54, 240, 128,      // U
                           128, 128, 240, 34, 110, 128}));  // V
    // 0.5 becomes 0.25 at gamma 0.5.
    image = Image<float>(1, 1);
    image.rgb = {0.5f, 0.5f, 0.5f};
    CHECK(y4m_frame(image, 0.5)[6] == 16 + (220 * 64 + 128) / 256);
}

}  // namespace packtrace::test
