#include "scene/scene_builder.hpp"
#include "scene/unit_vector.hpp"
#include "scene/values.hpp"

#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace packtrace::reader {
namespace {

/// Least volume of the parallelepiped that a matrix's unit columns or rows span. Rounding
/// leaves around 1e-16 of a flat one.
constexpr double flattest = 1e-12;

double spanned_volume(const Mat3& m)
{
    return std::abs(
        glm::determinant(Mat3(unit_vector(m[0]), unit_vector(m[1]), unit_vector(m[2]))));
}

bool is_singular(const Mat4& step)
{
    const Mat3 linear(step);
    // A strong but honest scale along one axis looks flat by its columns or by its rows only.
    return spanned_volume(linear) < flattest && spanned_volume(glm::transpose(linear)) < flattest;
}

/// scale = s or (x, y, z)
Mat4 read_scale(const Field& field)
{
    if (field.entry.kind == EntryKind::value && field.entry.value[0].kind == ItemKind::word)
        return glm::scale(Mat4(1.0), Vec3(read_number(field)));
    const std::vector<double> factors = read_numbers(field, 3, "(1, 2, 3)");
    return glm::scale(Mat4(1.0), Vec3(factors[0], factors[1], factors[2]));
}

struct SineCosine {
    double sine;
    double cosine;
};

/// Exact for whole quarter turns, which a round trip through radians is not.
SineCosine sine_cosine(double degrees)
{
    int quarters = 0;
    const double rest = glm::radians(std::remquo(degrees, 90.0, &quarters));
    const double sine = std::sin(rest);
    const double cosine = std::cos(rest);
    switch (static_cast<unsigned>(quarters) % 4u) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

/// Rodrigues' formula: x goes to y about z, y to z about x, z to x about y.
Mat4 axis_rotation(const Vec3& axis, double degrees)
{
    const auto [sine, cosine] = sine_cosine(degrees);
    const Mat3 cross{0.0, axis.z, -axis.y, -axis.z, 0.0, axis.x, axis.y, -axis.x, 0.0};
    return Mat4(cosine * Mat3(1.0) + sine * cross + (1.0 - cosine) * glm::outerProduct(axis, axis));
}

/// rotate = (axis x, y, z, degrees)
Mat4 read_rotate(const Field& field)
{
    const std::vector<double> numbers = read_numbers(field, 4, "(0, 1, 0, 45)");
    const Vec3 axis{numbers[0], numbers[1], numbers[2]};
    if (axis == Vec3(0.0))
        fail(field.source, field.entry.value[0].at,
             "'rotate' has the axis (0, 0, 0), which points nowhere; write (axis x, y, z, "
             "degrees), e.g. rotate = (0, 1, 0, 45)");
    return axis_rotation(unit_vector(axis), numbers[3]);
}

/// matrix = three rows of four numbers
Mat4 read_matrix(const Field& field)
{
    const std::vector<double> rows =
        read_numbers(field, 12, "(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)");
    Mat4 matrix(1.0);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            matrix[column][row] = rows[static_cast<std::size_t>(4 * row + column)];
    return matrix;
}

Mat4 read_step(const Field& field)
{
    const std::string_view key = field.entry.key.text;
    if (key == "scale")
        return read_scale(field);
    if (key == "rotate")
        return read_rotate(field);
    if (key == "matrix")
        return read_matrix(field);
    return glm::translate(Mat4(1.0), read_point(field));
}

bool is_transform(const Field& field)
{
    const Keys& keys = transform_keys();
    return std::find(keys.begin(), keys.end(), field.entry.key.text) != keys.end();
}

bool is_finite(const Mat4& matrix)
{
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            if (!std::isfinite(matrix[column][row]))
                return false;
    return true;
}

}  // namespace

const Keys& transform_keys()
{
    static const Keys keys{"scale", "rotate", "translate", "matrix"};
    return keys;
}

Mat4 build_transform(const Block& block)
{
    Mat4 transform(1.0);
    for (const Field& field : block.fields()) {
        if (!is_transform(field))
            continue;
        const Mat4 step = read_step(field);
        if (is_singular(step))
            field.fail("'" + std::string(field.entry.key.text) +
                       "' is singular, it flattens the object; use factors other than 0 and "
                       "columns that are independent");
        transform = step * transform;
        if (!is_finite(transform) || !std::isnormal(glm::determinant(Mat3(transform))))
            field.fail(
                "the transform's numbers leave double precision here; use factors "
                "nearer to 1");
    }
    return transform;
}

}  // namespace packtrace::reader
