#include "geometry/canonical_form.hpp"

#include "core/quad.hpp"
#include "scene/vectors.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace packtrace {
namespace {

constexpr double negligible = 1e-12;

/// A constant counts as 0 if it is at most this share of the numbers that cancel in it. Along the
/// world's axes squares are completed without rounding, so the only error is that of J as written.
/// Along turned axes each square and slope has an error of several roundoffs of the largest.
constexpr double aligned_rest = 0x1p-50;
constexpr double turned_rest = 0x1p-46;

struct SymmetricEigen {
    Vec3 values{0.0};
    Mat3 vectors{1.0};  ///< orthonormal columns, in the order of the values
};

/// The rotation in the plane of axes p and q that makes matrix[p][q] zero.
Mat3 jacobi_rotation(const Mat3& matrix, int p, int q)
{
    const double ratio = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
    const double tangent =
        std::copysign(1.0, ratio) / (std::abs(ratio) + std::sqrt(ratio * ratio + 1.0));
    const double cosine = 1.0 / std::sqrt(tangent * tangent + 1.0);
    Mat3 rotation(1.0);
    rotation[p][p] = cosine;
    rotation[q][q] = cosine;
    rotation[q][p] = tangent * cosine;
    rotation[p][q] = -tangent * cosine;
    return rotation;
}

/// Eigenvalues and eigenvectors of a symmetric matrix by cyclic Jacobi rotations (Golub and Van
/// Loan, Matrix Computations, section 8.5). A diagonal matrix comes back with its own axes.
SymmetricEigen symmetric_eigen(Mat3 matrix)
{
    SymmetricEigen result;
    // Convergence is quadratic; a 3x3 matrix needs five or six sweeps.
    for (int sweep = 0; sweep < 30; ++sweep) {
        bool changed = false;
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                const double diagonal = std::abs(matrix[p][p]) + std::abs(matrix[q][q]);
                if (diagonal + std::abs(matrix[p][q]) == diagonal)
                    continue;
                const Mat3 rotation = jacobi_rotation(matrix, p, q);
                matrix = glm::transpose(rotation) * matrix * rotation;
                matrix[p][q] = matrix[q][p] = 0.0;
                result.vectors = result.vectors * rotation;
                changed = true;
            }
        if (!changed)
            break;
    }
    result.values = {matrix[0][0], matrix[1][1], matrix[2][2]};
    return result;
}

int rank_of(const Vec3& square)
{
    return (square.x != 0.0) + (square.y != 0.0) + (square.z != 0.0);
}

/// Sets eigenvalues that are at most this share of the largest to 0, and moves them and their axes
/// to the end.
void sort_axes(SymmetricEigen& eigen, double share)
{
    const double limit = share * largest_component(eigen.values);
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(eigen.values[axis]) <= limit)
            eigen.values[axis] = 0.0;
    for (int pass = 0; pass < 2; ++pass)
        for (int axis = 0; axis < 2; ++axis)
            if (eigen.values[axis] == 0.0 && eigen.values[axis + 1] != 0.0) {
                std::swap(eigen.values[axis], eigen.values[axis + 1]);
                std::swap(eigen.vectors[axis], eigen.vectors[axis + 1]);
            }
}

/// Turns the axes without a square, so that the remaining linear part lies along the last axis. A
/// remaining part of at most this share of the whole counts as 0.
void align_linear(SymmetricEigen& eigen, const Vec3& slope, double share)
{
    if (rank_of(eigen.values) >= 2)
        return;
    Vec3 direction = slope;
    if (eigen.values.x != 0.0)
        direction -= eigen.vectors[0] * glm::dot(eigen.vectors[0], slope);
    if (glm::length(direction) <= share * glm::length(slope))
        return;
    eigen.vectors[2] = glm::normalize(direction);
    if (eigen.values.x == 0.0) {
        const int smallest = std::abs(eigen.vectors[2].x) < 0.6 ? 0 : 1;
        Vec3 other{0.0};
        other[smallest] = 1.0;
        eigen.vectors[0] = glm::normalize(glm::cross(other, eigen.vectors[2]));
    }
    eigen.vectors[1] = glm::cross(eigen.vectors[2], eigen.vectors[0]);
}

/// Moves the origin along the axes until no axis has both a square and a slope. A slope of at most
/// this share of the whole counts as 0. Far from the centre large numbers cancel in the constant,
/// which decides how wide a waist is and whether there is one. So it is computed in 113 bits.
void complete_squares(CanonicalForm& form, const Vec3& slope, double constant, double share)
{
    Vec3 shift{0.0};  // along the axes
    Quad rest = constant;
    for (int axis = 0; axis < 3; ++axis) {
        const double half = 0.5 * glm::dot(form.axes[axis], slope);
        if (form.square[axis] != 0.0) {
            shift[axis] = -half / form.square[axis];
            rest -= Quad(half) * half / form.square[axis];
        } else if (axis == 2 && std::abs(half) > share * glm::length(slope)) {
            form.linear = half;
        }
    }
    form.constant = static_cast<double>(rest);
    if (form.linear != 0.0) {
        shift.z = -form.constant / (2.0 * form.linear);
        form.constant = 0.0;
    }
    form.center = form.axes * shift;
}

/// The size of the numbers that cancel in the constant. Along turned axes each square counts as the
/// largest one, because its error is some roundoffs of the largest.
double size_of_rest(const CanonicalForm& form, double constant, bool is_turned)
{
    const double largest = largest_component(form.square);
    double size = std::abs(constant);
    for (int axis = 0; axis < 3; ++axis) {
        const double shift = glm::dot(form.axes[axis], form.center);
        if (form.square[axis] != 0.0)
            size += (is_turned ? largest : std::abs(form.square[axis])) * shift * shift;
    }
    return size;
}

}  // namespace

CanonicalForm canonical_form(const std::array<double, 10>& coefficients)
{
    const auto& [A, B, C, D, E, F, G, H, I, J] = coefficients;
    Mat3 matrix;
    matrix[0] = {A, D / 2, E / 2};
    matrix[1] = {D / 2, B, F / 2};
    matrix[2] = {E / 2, F / 2, C};
    const Vec3 slope{G, H, I};
    SymmetricEigen eigen = symmetric_eigen(matrix);
    // Along the world's axes coefficients are exact, so none of them is negligible.
    const bool is_turned = D != 0.0 || E != 0.0 || F != 0.0;
    const double share = is_turned ? negligible : 0.0;
    sort_axes(eigen, share);
    align_linear(eigen, slope, share);

    CanonicalForm form{.axes = eigen.vectors, .square = eigen.values};
    complete_squares(form, slope, J, share);
    // A constant that may be only a rounding error of cancelled squares counts as 0.
    const double rest = is_turned ? turned_rest : aligned_rest;
    if (std::abs(form.constant) <= rest * size_of_rest(form, J, is_turned))
        form.constant = 0.0;
    return form;
}

std::optional<std::string> why_no_surface(const CanonicalForm& form)
{
    const int rank = rank_of(form.square);
    if (rank == 0 && form.linear == 0.0)
        return "all coefficients but the last are 0";
    if (form.linear != 0.0)
        return std::nullopt;
    const bool positive = form.square.x > 0.0;
    for (int axis = 1; axis < rank; ++axis)
        if ((form.square[axis] > 0.0) != positive)
            return std::nullopt;
    if (form.constant == 0.0) {
        static const char* const shape[] = {"", "a plane counted twice", "a line", "a point"};
        return std::string("its surface is only ") + shape[rank];
    }
    if ((form.constant > 0.0) == positive)
        return "no point satisfies its equation";
    return std::nullopt;
}

}  // namespace packtrace
