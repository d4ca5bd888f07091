#include "reference/surfaces/affine.hpp"

namespace packtrace::reference {

template <class Real>
Affine<Real>::Affine(const Mat4& matrix) : origin_(packtrace::Vec3(matrix[3]))
{
    for (int i = 0; i < 3; ++i)
        columns_[i] = Vec3<Real>(packtrace::Vec3(matrix[i]));
    // Cramer's rule: the rows of the inverse are the cross products of the columns over the
    // determinant.
    const Real determinant = dot(columns_[0], cross(columns_[1], columns_[2]));
    for (int i = 0; i < 3; ++i)
        inverse_rows_[i] = cross(columns_[(i + 1) % 3], columns_[(i + 2) % 3]) / determinant;
}

template class Affine<float>;
template class Affine<double>;
template class Affine<long double>;

}  // namespace packtrace::reference
