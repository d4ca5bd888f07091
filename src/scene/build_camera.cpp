#include "scene/numbers.hpp"
#include "scene/scene_builder.hpp"
#include "scene/values.hpp"

#include <glm/matrix.hpp>

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <vector>

namespace packtrace::reader {
namespace {

/// Numbers of seven digits stay as they are; of four digits they are taken for the rotation that
/// they were rounded from.
constexpr double taken_as_given = 1e-6;
constexpr double taken_for_rotation = 1e-3;

/// The largest difference of transpose(m) m from the identity; infinite for NaN and for mirrors.
double distance_from_rotation(const Mat3& m)
{
    const Mat3 square = glm::transpose(m) * m;
    double distance = 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) {
            const double off = std::abs(square[column][row] - (column == row ? 1.0 : 0.0));
            distance = off <= distance ? distance : off;
        }
    return glm::determinant(m) > 0.0 ? distance : std::numeric_limits<double>::infinity();
}

/// The nearest rotation, by the Newton iteration for the polar decomposition (Higham, "Computing
/// the Polar Decomposition", 1986), which squares the distance with each step.
Mat3 nearest_rotation(Mat3 m)
{
    constexpr int steps = 5;
    for (int step = 0; step < steps; ++step)
        m = 0.5 * (m + glm::inverse(glm::transpose(m)));
    return m;
}

Mat3 read_rotation(const Field& field)
{
    const std::vector<double> rows = read_numbers(field, 9, "(1, 0, 0, 0, 1, 0, 0, 0, 1)");
    Mat3 rotation;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            rotation[column][row] = rows[static_cast<std::size_t>(3 * row + column)];
    const double distance = distance_from_rotation(rotation);
    if (distance <= taken_as_given)
        return rotation;
    if (!(distance <= taken_for_rotation))
        field.fail(
            "'rotation' is not a rotation: its rows have to be perpendicular, of length 1 and "
            "unmirrored within 1e-3; correct its numbers or use look_at");
    char rounded[16];
    std::snprintf(rounded, sizeof rounded, "%.1g", distance);
    warn(field.source, field.entry.key.at,
         std::string("'rotation' is a rotation only within ") + rounded +
             "; the nearest one is used; write its numbers with seven digits or use look_at");
    return nearest_rotation(rotation);
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
