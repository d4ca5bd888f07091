#include "catch.hpp"
#include "render_scene.hpp"
#include <packtrace/camera.hpp>
#include <packtrace/read_scene.hpp>

#include <glm/geometric.hpp>

#include <stdexcept>
#include <string>

namespace packtrace {

TEST_CASE("the canvas of note 001 spans the viewport", "[camera]")
{
    const CameraBasis basis = camera_basis(Camera{}, 200, 100);
    CHECK(basis.right == Vec3(1.0 / 200, 0, 0));
    CHECK(basis.up == Vec3(0, 1.0 / 100, 0));
    CHECK(basis.forward == Vec3(0, 0, 1));
}

TEST_CASE("a field of view makes the viewport follow the picture's shape", "[camera]")
{
    Camera camera{.fov = 90.0};
    const CameraBasis basis = camera_basis(camera, 200, 100);
    CHECK(glm::length(basis.right - Vec3(4.0 / 200, 0, 0)) < 1e-15);
    CHECK(glm::length(basis.up - Vec3(0, 2.0 / 100, 0)) < 1e-15);
}

TEST_CASE("a camera that looks along z has the identity rotation", "[camera]")
{
    const Mat3 rotation = look_at({0, 0, 0}, {0, 0, 5}, {0, 1, 0});
    CHECK(rotation == Mat3(1.0));
}

TEST_CASE("a camera that looks along its up direction is refused", "[camera]")
{
    CHECK_THROWS_AS(look_at({0, 0, 0}, {0, 3, 0}, {0, 1, 0}), std::invalid_argument);
}

namespace {

int pixels_hit(const auto& image)
{
    int count = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
        count += image.rgb[i] > 0 ? 1 : 0;
    return count;
}

/// Checks single and double precision on every instruction set.
void check_pixels_hit(const Scene& scene)
{
    const int truth = pixels_hit(test::render_scalar<long double>(scene));
    REQUIRE(truth > 0);
    for (const std::string& isa : test::supported_isas()) {
        CAPTURE(isa);
        CHECK(pixels_hit(test::render_packets<float>(scene, isa)) == truth);
        CHECK(pixels_hit(test::render_packets<double>(scene, isa)) == truth);
    }
}

}  // namespace

TEST_CASE("a picture does not depend on the distance of its viewport", "[camera]")
{
    for (const char* size : {"1e-15", "1e-12", "1e-11", "1e-9", "1", "3e9", "1e11", "1e13"}) {
        CAPTURE(size);
        const std::string far = size;
        check_pixels_hit(
            parse_scene("image_size = 64 x 64  illumination = whitted  viewport_size = " + far +
                            " x " + far + "  projection_plane_d = " + far + R"(
            background = rgb(0, 0, 1)
            sphere { center = (0, 0, 5)  radius = 1  ambient = 1 }
            light { type = ambient  intensity = 1 })",
                        "far", {}));
    }
}

TEST_CASE("views of nearly 180 degrees lose no object in any tile", "[camera]")
{
    const char* const scenes[] = {
        "image_size = 21 x 36  viewport_size = 5078.18 x 0.619306\n"
        "plane { point = (0, 1.303954, 0)  normal = (0, 1, 0)  ambient = 1 }\n",
        "image_size = 34 x 37  viewport_size = 9054.14 x 0.0807547\n"
        "sphere { center = (173.068672, 0.0576, 0.145593)  radius = 0.121942  ambient = 1 }\n",
        "image_size = 17 x 18  viewport_size = 6.60296e7 x 0.0267464\n"
        "plane { point = (0, -1.301969, 0)  normal = (0, 1, 0)  ambient = 1 }\n"};
    for (const char* text : scenes) {
        const Scene scene =
            parse_scene("illumination = whitted  background = rgb(0, 0, 1)\n" + std::string(text) +
                            "light { type = ambient  intensity = 1 }\n",
                        "wide", {});
        CAPTURE(text);
        check_pixels_hit(scene);
    }
}

}  // namespace packtrace
