#pragma once

#include <packtrace/surface.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace packtrace {

/// The sections of a clipped quadric at constant z, in its own space, if they are ellipses of one
/// shape: (p - c)ᵀ Q (p - c) = w(z), where c moves along a straight line.
struct EllipticSections {
    Vec2 center;           ///< c at z = 0
    Vec2 slope;            ///< change of c per unit of z
    glm::dmat2 half_axes;  ///< M of Q⁻¹ = M Mᵀ: p is c + √w M u for some u of length 1
    double widest;         ///< the largest w in the clip range; below 0 if no surface is left
    double rounding;       ///< bound of the rounding error of `widest`
};

/// Not set for a quadric without a clip, and for sections that are not ellipses around the inside.
[[nodiscard]] inline std::optional<EllipticSections> elliptic_sections(const Quadric& quadric)
{
    const auto& [A, B, C, D, E, F, G, H, I, J] = quadric.coefficients;
    const double determinant = A * B - 0.25 * D * D;
    // Sections that are almost parabolas have too large rounding errors at their ends.
    if (!quadric.z_range || !(A > 0.0) || !(B > 0.0) || !(determinant > 1e-6 * A * B))
        return std::nullopt;
    const glm::dmat2 inverse(B / determinant, -0.5 * D / determinant, -0.5 * D / determinant,
                             A / determinant);
    const Vec2 constant = 0.5 * Vec2(G, H);
    const Vec2 by_z = 0.5 * Vec2(E, F);
    EllipticSections sections;
    sections.center = -(inverse * constant);
    sections.slope = -(inverse * by_z);
    const double first = std::sqrt(inverse[0][0]);
    const double below = inverse[0][1] / first;
    sections.half_axes = glm::dmat2(first, below, 0.0, std::sqrt(inverse[1][1] - below * below));

    const double square = -glm::dot(by_z, sections.slope) - C;
    const double linear = -2.0 * glm::dot(by_z, sections.center) - I;
    const double rest = -glm::dot(constant, sections.center) - J;
    const auto w = [&](double z) { return (square * z + linear) * z + rest; };
    const auto& [low, high] = *quadric.z_range;
    const double top = square < 0.0 ? -linear / (2.0 * square) : low;
    sections.widest = std::max(w(low), w(high));
    if (top > low && top < high)
        sections.widest = std::max(sections.widest, w(top));
    const double height = std::max(std::abs(low), std::abs(high));
    const double along_axis = (std::abs(C) * height + std::abs(I)) * height + std::abs(J);
    const Vec2 off_axis = glm::abs(constant) + height * glm::abs(by_z);
    const Vec2 reach = glm::abs(sections.center) + height * glm::abs(sections.slope);
    // The terms of the determinant cancel, and the inverse loses as many digits.
    const double cancelled = A * B / determinant;
    sections.rounding = 1e-15 * (along_axis + cancelled * glm::dot(off_axis, reach));
    return sections;
}

}  // namespace packtrace
