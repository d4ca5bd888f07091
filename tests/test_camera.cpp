#include <packtrace/camera.hpp>

#include <stdexcept>

#include <glm/geometric.hpp>

#include "catch.hpp"

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
    Camera camera;
    camera.fov = 90.0;
    const CameraBasis basis = camera_basis(camera, 200, 100);
    CHECK(glm::length(basis.right - Vec3(4.0 / 200, 0, 0)) < 1e-15);
    CHECK(glm::length(basis.up - Vec3(0, 2.0 / 100, 0)) < 1e-15);
}

TEST_CASE("looking along z gives the identity rotation", "[camera]")
{
    const Mat3 rotation = look_at({0, 0, 0}, {0, 0, 5}, {0, 1, 0});
    CHECK(rotation == Mat3(1.0));
}

TEST_CASE("looking along up is refused", "[camera]")
{
    CHECK_THROWS_AS(look_at({0, 0, 0}, {0, 3, 0}, {0, 1, 0}), std::invalid_argument);
}

}  // namespace packtrace
