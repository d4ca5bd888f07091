#include "geometry/symmetric_eigen.hpp"

#include <cmath>

#include <glm/matrix.hpp>

namespace packtrace {
namespace {

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

}  // namespace

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

}  // namespace packtrace
