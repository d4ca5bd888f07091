#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// A quadric in world space under its object's transform; `check_object` has let it pass.
[[nodiscard]] LoweredQuadric lower_quadric(const Object& object, const Quadric& quadric,
                                           std::int32_t surface);

/// The ellipsoid that a sphere becomes under a transform that is no similarity.
[[nodiscard]] Quadric as_quadric(const Sphere& sphere);

}  // namespace packtrace
