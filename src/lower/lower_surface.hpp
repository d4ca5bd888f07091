#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Appends the surface of `object` to the list of its kind, in world space.
void lower_surface(const Object& object, std::int32_t number, LoweredScene& lowered);

/// Finds the spheres whose radius dwarfs the rest of the scene seen from `eye`, and their
/// anchors.
void mark_huge_spheres(const Vec3& eye, LoweredScene& lowered);

}  // namespace packtrace
