#include "scene/numbers.hpp"
#include "scene/scene_builder.hpp"
#include "scene/values.hpp"

#include <glm/matrix.hpp>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace packtrace::reader {
namespace {

constexpr double orthonormal_tolerance = 1e-6;

bool is_rotation(const Mat3& rotation)
{
    const Mat3 square = glm::transpose(rotation) * rotation;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(square[column][row] - (column == row ? 1.0 : 0.0)) <=
                  orthonormal_tolerance))
                return false;
    return glm::determinant(rotation) > 0.0;
}

Mat3 read_rotation(const Field& field)
{
    const std::vector<double> rows = read_numbers(field, 9, "(1, 0, 0, 0, 1, 0, 0, 0, 1)");
    Mat3 rotation;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            rotation[column][row] = rows[static_cast<std::size_t>(3 * row + column)];
    if (!is_rotation(rotation))
        field.fail(
            "'rotation' is not a rotation: its rows have to be perpendicular, of length 1 and "
            "unmirrored within 1e-6; correct its numbers or use look_at");
    return rotation;
}

double read_fov(const Field& field)
{
    const double fov = read_number(field);
    if (!(fov > 0.0 && fov < 180.0))
        fail(field.source, field.entry.value[0].at,
             "'fov' is " + to_text(fov) + " degrees; use an angle above 0 and below 180");
    return fov;
}

void build_rotation(const Block& block, Camera& camera)
{
    const auto rotation = block.find("rotation");
    const auto target = block.find("look_at");
    if (rotation && target)
        rotation->fail("'rotation' and 'look_at' both turn the camera; remove one of them");
    if (const auto up_field = block.find("up"); up_field && !target)
        up_field->fail("'up' has no effect without 'look_at'; add look_at or remove it");
    Vec3 up{0.0, 1.0, 0.0};
    block.set("up", up, read_direction);
    if (rotation)
        camera.rotation = read_rotation(*rotation);
    if (target)
        camera.rotation = view_rotation(*target, camera.position, read_point(*target), up);
}

}  // namespace

Mat3 view_rotation(const Field& field, const Vec3& position, const Vec3& target, const Vec3& up)
{
    try {
        return look_at(position, target, up);
    } catch (const std::invalid_argument&) {
        field.fail(
            "'look_at' is the camera's own position or straight along 'up'; move one of them "
            "or give another up");
    }
}

void build_camera(const Field& field, Camera& camera)
{
    const Block block(field, "camera", {"position", "look_at", "up", "rotation", "fov"});
    block.set("position", camera.position, read_point);
    block.set("fov", camera.fov, read_fov);
    build_rotation(block, camera);
}

}  // namespace packtrace::reader
