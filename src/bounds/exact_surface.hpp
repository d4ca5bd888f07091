#pragma once

#include "bounds/ball.hpp"
#include <packtrace/scene.hpp>

#include <array>
#include <optional>
#include <vector>

namespace packtrace::bounds {

/// A surface as p·S p + 2 l·p + k = 0 in a space of its own, negative inside:
/// p = M⁻¹ (P - offset) - center. The scene's numbers are taken as exact.
struct ExactSurface {
    BallVec square[3];  ///< rows of the symmetric S
    BallVec linear;
    Ball constant;
    Vec3 center{0.0};
    bool placed = false;  ///< false: M is 1, and offset 0
    BallVec inverse[3];   ///< rows of M⁻¹
    Vec3 offset{0.0};
    std::optional<ZRange> z_range;
    bool capped = false;
    /// Of a x² = b y², along any two axes: the normals of its two planes.
    std::optional<std::array<BallVec, 2>> sheets;

    /// Edges of a polygon, relative to `center`, two ends each. `linear` is half a normal of its
    /// plane.
    std::vector<std::array<BallVec, 2>> edges;

    ExactSurface(const Surface& from, const Mat4& transform);

    [[nodiscard]] BallVec point_to_own(const Vec3& P) const;
    [[nodiscard]] BallVec direction_to_own(const BallVec& d) const;
    [[nodiscard]] Ball value(const BallVec& p) const;
    /// Half the gradient of `value`.
    [[nodiscard]] BallVec gradient(const BallVec& p) const;
    /// S v.
    [[nodiscard]] BallVec second_order(const BallVec& v) const;
};

}  // namespace packtrace::bounds
