#pragma once

#include <packtrace/vec.hpp>

#include <array>
#include <optional>
#include <string>

namespace packtrace {

/// A quadric in the axes in which it is s0 x² + s1 y² + s2 z² + 2 linear z + constant = 0. A point
/// p in canonical space is center + axes p in the quadric's own space.
struct CanonicalForm {
    Vec3 center{0.0};
    Mat3 axes{1.0};  ///< orthonormal columns
    Vec3 square{0.0};
    double linear = 0.0;
    double constant = 0.0;
};

/// Brings Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy + Iz + J = 0 to its canonical form: by the
/// eigenvectors of the second-order part (Jacobi's method), then by completing squares. A constant
/// that may be only a rounding error counts as 0. If D, E or F is not 0, a coefficient also counts
/// as 0 if it is at most 1e-12 times the largest of its order.
[[nodiscard]] CanonicalForm canonical_form(const std::array<double, 10>& coefficients);

/// Why a ray cannot hit the form: it is empty, a point, a line or a double plane. Not set for other
/// forms.
[[nodiscard]] std::optional<std::string> why_no_surface(const CanonicalForm& form);

}  // namespace packtrace
