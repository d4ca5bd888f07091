#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Whether a point light is so far from everything, for the size of some body, that rays from it in
/// single precision could miss points there by some thousandths of that size, while rays from the
/// points miss nothing by as much: it is well outside of all bodies with bounds, and well off all
/// others. docs/numerics_derivations.md has the proof.
[[nodiscard]] bool is_far(const Vec3& light, const LoweredScene& lowered);

}  // namespace packtrace
