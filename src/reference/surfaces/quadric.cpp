// Finds the canonical form of a quadric.
#include "reference/surfaces/quadric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace packtrace::reference {
namespace {

using Wide = long double;
using V = Vec3<Wide>;

// Coefficients are doubles: where a sum cancels, a few units of their last place may remain.
constexpr Wide negligible = 64 * std::numeric_limits<double>::epsilon();

struct Eigen {
    V vectors[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Wide values[3];
};

// Turns the axes p and q so that matrix[p][q] becomes 0 (Golub and Van Loan, Matrix Computations,
// section 8.5).
void rotate_axes(Wide (&matrix)[3][3], Eigen& eigen, int p, int q)
{
    const Wide ratio = (matrix[q][q] - matrix[p][p]) / (2 * matrix[p][q]);
    const Wide tangent = std::copysign(Wide(1), ratio) / (std::abs(ratio) + std::hypot(1, ratio));
    const Wide cosine = 1 / std::hypot(1, tangent);
    const Wide sine = tangent * cosine;
    for (Wide* row : {matrix[0], matrix[1], matrix[2]}) {
        const Wide old = row[p];
        row[p] = cosine * old - sine * row[q];
        row[q] = sine * old + cosine * row[q];
    }
    for (int k = 0; k < 3; ++k) {
        const Wide old = matrix[p][k];
        matrix[p][k] = cosine * old - sine * matrix[q][k];
        matrix[q][k] = sine * old + cosine * matrix[q][k];
    }
    matrix[p][q] = matrix[q][p] = 0;
    const V old = eigen.vectors[p];
    eigen.vectors[p] = cosine * old - sine * eigen.vectors[q];
    eigen.vectors[q] = sine * old + cosine * eigen.vectors[q];
}

// A diagonal matrix keeps its axes.
Eigen eigen_of(Wide (&matrix)[3][3])
{
    Eigen eigen;
    // Convergence is quadratic: five or six sweeps suffice.
    for (int sweep = 0; sweep < 30; ++sweep)
        for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
            const Wide diagonal = std::abs(matrix[p][p]) + std::abs(matrix[q][q]);
            if (diagonal + std::abs(matrix[p][q]) != diagonal)
                rotate_axes(matrix, eigen, p, q);
        }
    for (int axis = 0; axis < 3; ++axis)
        eigen.values[axis] = matrix[axis][axis];
    return eigen;
}

// Axes without a square go last.
void sort_axes(Eigen& eigen)
{
    Wide largest = 0;
    for (const Wide value : eigen.values)
        largest = std::max(largest, std::abs(value));
    for (Wide& value : eigen.values)
        if (std::abs(value) <= negligible * largest)
            value = 0;
    for (const int axis : {0, 1, 0})
        if (eigen.values[axis] == 0 && eigen.values[axis + 1] != 0) {
            std::swap(eigen.values[axis], eigen.values[axis + 1]);
            std::swap(eigen.vectors[axis], eigen.vectors[axis + 1]);
        }
}

// Turns the axes without a square, if there are two or three, so that the slope lies along the
// last.
void align_slope(Eigen& eigen, const V& slope)
{
    const bool has_square = eigen.values[0] != 0;
    if (eigen.values[1] != 0)
        return;
    const V along = has_square ? slope - dot(eigen.vectors[0], slope) * eigen.vectors[0] : slope;
    if (length(along) <= negligible * length(slope))
        return;
    eigen.vectors[2] = normalize(along);
    if (!has_square) {
        const V& n = eigen.vectors[2];
        const V other = std::abs(n.x) < Wide(0.6L) ? V(1, 0, 0) : V(0, 1, 0);
        eigen.vectors[0] = normalize(cross(other, n));
    }
    eigen.vectors[1] = cross(eigen.vectors[2], eigen.vectors[0]);
}

// Moves the centre until no axis has both a square and a slope.
CanonicalQuadric<Wide> complete_squares(const Eigen& eigen, const V& slope, Wide constant)
{
    CanonicalQuadric<Wide> form;
    std::copy(eigen.vectors, eigen.vectors + 3, form.axes);
    form.square = {eigen.values[0], eigen.values[1], eigen.values[2]};
    form.constant = constant;
    for (int axis = 0; axis < 3; ++axis) {
        const Wide half = dot(form.axes[axis], slope) / 2;
        const Wide square = eigen.values[axis];
        if (square != 0) {
            form.center += (-half / square) * form.axes[axis];
            form.constant -= half * half / square;
        } else if (axis == 2 && std::abs(half) > negligible * length(slope)) {
            form.linear = half;
        }
    }
    if (std::abs(form.constant) <=
        negligible * (std::abs(constant) + std::abs(form.constant - constant)))
        form.constant = 0;
    if (form.linear != 0) {
        form.center += (-form.constant / (2 * form.linear)) * form.axes[2];
        form.constant = 0;
    }
    return form;
}

template <class Real>
Vec3<Real> rounded(const V& v)
{
    return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

}  // namespace

template <class Real>
CanonicalQuadric<Real> canonical_quadric(const std::array<double, 10>& coefficients)
{
    const auto [A, B, C, D, E, F, G, H, I, J] = coefficients;
    Wide matrix[3][3] = {{A, D / 2, E / 2}, {D / 2, B, F / 2}, {E / 2, F / 2, C}};
    Eigen eigen = eigen_of(matrix);
    const V slope(G, H, I);
    sort_axes(eigen);
    align_slope(eigen, slope);
    const CanonicalQuadric<Wide> form = complete_squares(eigen, slope, J);
    return {{rounded<Real>(form.axes[0]), rounded<Real>(form.axes[1]), rounded<Real>(form.axes[2])},
            rounded<Real>(form.center),
            rounded<Real>(form.square),
            static_cast<Real>(form.linear),
            static_cast<Real>(form.constant)};
}

template CanonicalQuadric<float> canonical_quadric(const std::array<double, 10>&);
template CanonicalQuadric<double> canonical_quadric(const std::array<double, 10>&);
template CanonicalQuadric<long double> canonical_quadric(const std::array<double, 10>&);

}  // namespace packtrace::reference
