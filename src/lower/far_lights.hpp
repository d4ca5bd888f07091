#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Whether shadow rays of a point light must start at the points rather than at the light. That is
/// so if the light is so far away that rays from it in single precision could miss points by some
/// thousandths of a body's size, and if it is well outside of all bounded bodies and well off all
/// others, so that rays from the points are more exact. docs/numerics_derivations.md has the proof.
[[nodiscard]] bool is_far(const Vec3& light, const LoweredScene& lowered);

}  // namespace packtrace
