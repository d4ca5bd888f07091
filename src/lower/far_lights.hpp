#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Whether a point light is so far from a body that casts a shadow, for that body's size, that rays
/// from it in single precision could miss points there by some thousandths of that size; so is any
/// where no such body has bounds. docs/numerics_derivations.md has the proof.
[[nodiscard]] bool is_far(const Vec3& light, const LoweredScene& lowered);

}  // namespace packtrace
