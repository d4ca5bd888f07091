#include "core/text.hpp"
#include "scene/language/rows.hpp"
#include "scene/vectors.hpp"

#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

// The keys with matrices: an object's transforms and the camera's rotation.
namespace packtrace::language {
namespace {

/// The smallest volume of the parallelepiped spanned by a matrix's normalised columns or rows. For
/// a flat matrix the volume is about 1e-16, because of rounding.
constexpr double flattest = 1e-12;

double spanned_volume(const Mat3& m)
{
    return std::abs(
        glm::determinant(Mat3(unit_vector(m[0]), unit_vector(m[1]), unit_vector(m[2]))));
}

bool is_singular(const Mat3& linear)
{
    // A valid matrix with a strong scale along one axis looks flat by its columns or by its rows,
    // but not by both.
    return spanned_volume(linear) < flattest && spanned_volume(glm::transpose(linear)) < flattest;
}

struct SineCosine {
    double sine;
    double cosine;
};

/// Exact for multiples of a quarter turn. The detour through radians would not be.
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

}  // namespace

Mat4 axis_rotation(const Vec3& axis, double degrees)
{
    const auto [sine, cosine] = sine_cosine(degrees);
    const Mat3 cross{0.0, axis.z, -axis.y, -axis.z, 0.0, axis.x, axis.y, -axis.x, 0.0};
    return Mat4(cosine * Mat3(1.0) + sine * cross + (1.0 - cosine) * glm::outerProduct(axis, axis));
}

namespace {

template <int columns, class Matrix>
void set_rows(Matrix& matrix, const std::vector<double>& rows)
{
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < columns; ++column)
            matrix[column][row] = rows[static_cast<std::size_t>(columns * row + column)];
}

template <int columns, class Matrix>
void append_rows(std::string& out, const Matrix& matrix)
{
    std::array<double, std::size_t{3 * columns}> rows{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < columns; ++column)
            rows[static_cast<std::size_t>(columns * row + column)] = matrix[column][row];
    append(out, rows);
}

Mat4 read_scale(const Field& field)
{
    const Vec3 factors =
        is_word(field) ? Vec3(read_number(field)) : to_vector(read_numbers(field, 3, "(1, 2, 3)"));
    return glm::scale(Mat4(1.0), factors);
}

Mat4 read_rotate(const Field& field)
{
    const std::vector<double> numbers = read_numbers(field, 4, "(0, 1, 0, 45)");
    const Vec3 axis = to_vector(numbers);
    if (axis == Vec3(0.0))
        fail(field.source, field.entry.value[0].at,
             "'rotate' has the axis (0, 0, 0), which points nowhere; write (axis x, y, z, "
             "degrees), e.g. rotate = (0, 1, 0, 45)");
    return axis_rotation(unit_vector(axis), numbers[3]);
}

Mat4 read_translate(const Field& field)
{
    return glm::translate(Mat4(1.0), point().read(field));
}

Mat4 read_matrix(const Field& field)
{
    Mat4 matrix(1.0);
    set_rows<4>(matrix, read_numbers(field, 12, "(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)"));
    return matrix;
}

/// The twelve numbers of an affine map, row by row, as in a scene file.
std::array<double, 12> numbers_of(const Mat4& matrix)
{
    std::array<double, 12> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = matrix[static_cast<int>(i % 4)][static_cast<int>(i / 4)];
    return numbers;
}

bool is_affine(const Mat4& matrix)
{
    return matrix[0][3] == 0.0 && matrix[1][3] == 0.0 && matrix[2][3] == 0.0 && matrix[3][3] == 1.0;
}

double largest_entry(const Mat3& matrix)
{
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            largest = std::max(largest, std::abs(matrix[column][row]));
    return largest;
}

void apply(Mat4& transform, const Mat4& step, const Field& field)
{
    transform = step * transform;
    if (const Fault fault = fault_of_transform(transform))
        field.refuse(field.entry.key.at, *fault);
}

Row<Mat4> step(std::string_view key, std::string_view takes, Mat4 (*read)(const Field&),
               std::string_view meaning)
{
    return {.key = key,
            .meaning = meaning,
            .takes = std::string(takes),
            .read = [read](const Field& field,
                           Mat4& transform) { apply(transform, read(field), field); },
            .write = append_rows<4, Mat4>,
            // Only the matrix of a transform is stored, so only this key is written.
            .is_set = [key](const Mat4& m) { return key == "matrix" && m != Mat4(1.0); },
            .check = {},
            .repeatable = true};
}

/// Matrices written with seven digits are used unchanged. Matrices written with four digits are
/// replaced by the rotation that they were rounded from.
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

/// The nearest rotation, by Newton's iteration for the polar decomposition (Higham, "Computing the
/// Polar Decomposition", 1986). Each step squares the distance.
Mat3 nearest_rotation(Mat3 m)
{
    constexpr int steps = 5;
    for (int step = 0; step < steps; ++step)
        m = 0.5 * (m + glm::inverse(glm::transpose(m)));
    return m;
}

const std::string not_a_rotation =
    "'rotation' is not a rotation: its rows have to be perpendicular, of length 1 and unmirrored; "
    "correct its numbers or use look_at";

Fault fault_of_rotation(std::string_view key, const Mat3& rotation)
{
    const Mat3 rows = glm::transpose(rotation);
    for (int row = 0; row < 3; ++row)
        if (Fault fault = fault_of(key, rows[row], any_number))
            return fault;
    return distance_from_rotation(rotation) <= taken_as_given ? std::nullopt
                                                              : Fault(not_a_rotation);
}

Mat3 read_rotation(const Field& field)
{
    Mat3 rotation;
    set_rows<3>(rotation, read_numbers(field, 9, "(1, 0, 0, 0, 1, 0, 0, 0, 1)"));
    const double distance = distance_from_rotation(rotation);
    if (distance <= taken_as_given)
        return rotation;
    if (!(distance <= taken_for_rotation))
        field.refuse(field.entry.key.at, not_a_rotation);
    warn(field.source, field.entry.key.at,
         std::string("'rotation' is a rotation only within ") + brief(distance, 1) +
             "; the nearest one is used; write its numbers with seven digits or use look_at");
    return nearest_rotation(rotation);
}

}  // namespace

Fault fault_of_transform(const Mat4& transform)
{
    if (transform == Mat4(1.0))
        return std::nullopt;
    if (Fault fault = fault_of("matrix", numbers_of(transform), any_number))
        return fault;
    if (!is_affine(transform))
        return "the transform is not affine; make the last row of its matrix (0, 0, 0, 1)";
    constexpr double rounding = 1e-12;
    const Mat3 linear(transform);
    if (is_singular(linear))
        return "the transform is singular, it flattens the object; use factors other than 0 and "
               "columns that are independent";
    if (!std::isnormal(glm::determinant(linear)) ||
        !(largest_entry(glm::inverse(linear)) <= (1.0 + rounding) / smallest_length))
        return "the transform shrinks the object to less than 1e-15 of its size; use factors "
               "nearer to 1";
    return std::nullopt;
}

Rows<Mat4> transform_rows()
{
    return {
        step("scale", "`s` or `(sx, sy, sz)`", read_scale,
             "about the origin; below 0 mirrors, 0 is an error"),
        step("rotate", "`(ax, ay, az, degrees)`", read_rotate,
             "about the axis (ax, ay, az) through the origin"),
        step("translate", "`(x, y, z)`", read_translate, "moves it"),
        step("matrix", "twelve numbers, three rows of four", read_matrix,
             "`p' = M p + t`, the fourth column is t; singular is an error"),
    };
}

Type<Mat3> rotation()
{
    return {"nine numbers, row by row", read_rotation, append_rows<3, Mat3>, fault_of_rotation};
}

}  // namespace packtrace::language
