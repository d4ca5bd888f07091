#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Appends the material of `object`, times the scene's ambient light, and its checker.
void lower_material(const Object& object, const Rgb& ambient, LoweredScene& lowered);

}  // namespace packtrace
