#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// What an illumination model asks of the one equation beyond its materials.
void lower_model_rules(const Scene& scene, LoweredScene& lowered);

/// Whether the model shades a surface's normal turned against the ray, or as it points outwards.
[[nodiscard]] bool normal_faces_viewer(const Scene& scene, const Object& object);

}  // namespace packtrace
