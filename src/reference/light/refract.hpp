#pragma once

#include "reference/vec3.hpp"

#include <cmath>
#include <optional>

namespace packtrace::reference {

/// The direction after Snell's law n1 sin(i) = n2 sin(r), for unit `D` and unit `N` turned
/// against it; nothing at total internal reflection. Unit again, to rounding.
template <class Real>
[[nodiscard]] std::optional<Vec3<Real>> refract(const Vec3<Real>& D, const Vec3<Real>& N, Real n1,
                                                Real n2)
{
    const Real eta = n1 / n2;
    const Real cos_i = -dot(N, D);
    const Real cos_r_squared = 1 - eta * eta * (1 - cos_i * cos_i);
    if (cos_r_squared < 0)
        return std::nullopt;
    return eta * D + (eta * cos_i - std::sqrt(cos_r_squared)) * N;
}

}  // namespace packtrace::reference
