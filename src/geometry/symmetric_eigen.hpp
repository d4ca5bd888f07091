#pragma once

#include <packtrace/vec.hpp>

namespace packtrace {

struct SymmetricEigen {
    Vec3 values{0.0};
    Mat3 vectors{1.0};  ///< orthonormal columns, in the order of the values
};

/// Eigenvalues and eigenvectors of a symmetric matrix by cyclic Jacobi rotations (Golub and Van
/// Loan, Matrix Computations, section 8.5). A diagonal matrix comes back with its own axes.
[[nodiscard]] SymmetricEigen symmetric_eigen(Mat3 matrix);

}  // namespace packtrace
