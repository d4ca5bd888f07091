#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <packtrace/scene.hpp>

#include "geometry/canonical_form.hpp"
#include "lab/truth/wide.hpp"

namespace packtrace::lab {

/// A surface of any kind as p·S p + 2 l·p + c = 0 in its own space, negative inside, and its way
/// into the world; exactly what the scene says.
struct WideSurface {
    WideVec square[3];  ///< rows of the symmetric S
    WideVec linear;
    Wide constant = 0;
    bool placed = false;  ///< false: own space is the world's
    WideVec world[3];     ///< rows of own to world
    WideVec own[3];       ///< rows of world to own
    WideVec offset;       ///< where own 0 is in the world
    /// Magnitudes of what places the surface besides its own points: a centre, a point, an offset.
    WideVec place;
    bool by_points = true;  ///< own points count as inputs: not for spheres and planes
    /// Of a general quadric: what kernels hold it by, whose entries count as inputs.
    std::optional<CanonicalForm> canonical;
    std::optional<ZRange> z_range;
    bool capped = false;
    /// Of x² = z² and its like: normals of the two planes, whose product the equation is.
    std::optional<std::array<WideVec, 2>> sheets;
    /// Edges of a polygon, two ends each; `linear` is half a normal of its plane.
    std::vector<std::array<WideVec, 2>> edges;
    std::int32_t object = 0;

    explicit WideSurface(const Object& from, std::int32_t number);

    [[nodiscard]] WideVec point_to_own(const WideVec& P) const;
    [[nodiscard]] WideVec direction_to_own(const WideVec& d) const;
    [[nodiscard]] Wide value(const WideVec& p) const;
    /// Half the gradient of `value`.
    [[nodiscard]] WideVec gradient(const WideVec& p) const;
    [[nodiscard]] WideVec second_order(const WideVec& v) const;
    /// Covectors go into the world by the transposed inverse.
    [[nodiscard]] WideVec covector_to_world(const WideVec& n) const;
};

}  // namespace packtrace::lab
