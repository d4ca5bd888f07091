#pragma once

#include "reference/vec3.hpp"
#include <packtrace/vec.hpp>

namespace packtrace::reference {

/// An object's matrix and its inverse, between own space, where the surface is defined, and world
/// space. t along a ray is the same in both, as directions are not normalised.
template <class Real>
class Affine {
public:
    /// `matrix` goes from own space to the world; must not be singular.
    explicit Affine(const Mat4& matrix);

    [[nodiscard]] Vec3<Real> point_to_own(const Vec3<Real>& p) const
    {
        return vector_to_own(p - origin_);
    }
    [[nodiscard]] Vec3<Real> vector_to_own(const Vec3<Real>& v) const
    {
        return {dot(inverse_rows_[0], v), dot(inverse_rows_[1], v), dot(inverse_rows_[2], v)};
    }
    [[nodiscard]] Vec3<Real> point_to_world(const Vec3<Real>& p) const
    {
        return vector_to_world(p) + origin_;
    }
    [[nodiscard]] Vec3<Real> vector_to_world(const Vec3<Real>& v) const
    {
        return v.x * columns_[0] + v.y * columns_[1] + v.z * columns_[2];
    }
    /// By the inverse transpose, so that the normal stays perpendicular; not normalised.
    [[nodiscard]] Vec3<Real> normal_to_world(const Vec3<Real>& n) const
    {
        return n.x * inverse_rows_[0] + n.y * inverse_rows_[1] + n.z * inverse_rows_[2];
    }

private:
    Vec3<Real> columns_[3];
    Vec3<Real> inverse_rows_[3];
    Vec3<Real> origin_;
};

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

}  // namespace packtrace::reference
