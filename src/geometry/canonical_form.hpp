#pragma once

#include <packtrace/vec.hpp>

#include <array>
#include <optional>
#include <string>

namespace packtrace {

/// A quadric in axes that make it s0 x² + s1 y² + s2 z² + 2 linear z + constant = 0: its own space
/// is reached by x_own = center + axes p.
struct CanonicalForm {
    Vec3 center{0.0};
    Mat3 axes{1.0};  ///< orthonormal columns
    Vec3 square{0.0};
    double linear = 0.0;
    double constant = 0.0;
};

/// Brings Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy + Iz + J = 0 to its canonical form: by the
/// eigenvectors of the second-order part (Jacobi's method), then by completing squares.
/// What rounding could have left over of the constant counts as 0. So do coefficients within 1e-12
/// of nothing, against the largest of their order, where the axes are not those of the world.
[[nodiscard]] CanonicalForm canonical_form(const std::array<double, 10>& coefficients);

/// Why the form has no surface a ray can hit (it is empty, a point, a line or a double plane);
/// nothing when it has one.
[[nodiscard]] std::optional<std::string> why_no_surface(const CanonicalForm& form);

}  // namespace packtrace
