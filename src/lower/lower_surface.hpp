#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Appends the surface of `object`, numbered `surface`, to the list of its kind, in world space.
/// Returns how many surface numbers it takes.
[[nodiscard]] int lower_surface(const Object& object, std::int32_t surface, LoweredScene& lowered);

/// Moves the spheres whose surface passes near the world's origin for their size, such as grounds,
/// to a list of their own, and finds their anchors.
void part_anchored_spheres(LoweredScene& lowered);

}  // namespace packtrace
