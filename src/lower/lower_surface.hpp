#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Appends the surface of `object`, numbered `surface`, to the list of its kind, in world space.
/// Returns how many surface numbers it takes.
[[nodiscard]] int lower_surface(const Object& object, std::int32_t surface, LoweredScene& lowered);

/// Moves the spheres whose radius dwarfs the rest of the scene seen from `eye` to a list of their
/// own, and finds their anchors.
void part_huge_spheres(const Vec3& eye, LoweredScene& lowered);

}  // namespace packtrace
