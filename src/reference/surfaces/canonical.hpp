#pragma once

#include "reference/vec3.hpp"

#include <array>

namespace packtrace::reference {

/// A quadric in axes that make it s.x x² + s.y y² + s.z z² + 2 linear z + constant = 0, where
/// p = (axes[0].q, axes[1].q, axes[2].q) with q = own - center. Only one of s.z and linear is
/// not 0.
template <class Real>
struct CanonicalQuadric {
    Vec3<Real> axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3<Real> center;
    Vec3<Real> square;
    Real linear{};
    Real constant{};
};

/// The canonical form of Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy + Iz + J = 0, found in long
/// double: the axes are eigenvectors (Jacobi's method). What is left of coefficients, as doubles
/// are, that cancel counts as 0.
template <class Real>
[[nodiscard]] CanonicalQuadric<Real> canonical_quadric(const std::array<double, 10>& coefficients);

}  // namespace packtrace::reference
