#pragma once

#include <algorithm>
#include <optional>

#include <packtrace/surface.hpp>

namespace packtrace {

/// The largest value of -(C z² + I z + J) within a clipped quadric's heights, for those that are
/// round about their own z axis, stretched or not: x² A + y² B is at most that on the surface, of
/// which nothing is left where it is below 0.
[[nodiscard]] inline std::optional<double> widest_section(const Quadric& quadric)
{
    const auto& k = quadric.coefficients;
    const bool about_z = k[3] == 0.0 && k[4] == 0.0 && k[5] == 0.0 && k[6] == 0.0 && k[7] == 0.0;
    if (!quadric.z_range || !about_z || !(k[0] > 0.0) || !(k[1] > 0.0))
        return std::nullopt;
    const auto& [low, high] = *quadric.z_range;
    const auto section = [&](double z) { return -((k[2] * z + k[8]) * z + k[9]); };
    const double widest = std::max(section(low), section(high));
    const double top = k[2] > 0.0 ? -k[8] / (2.0 * k[2]) : low;
    return top > low && top < high ? std::max(widest, section(top)) : widest;
}

}  // namespace packtrace
