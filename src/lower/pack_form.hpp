#pragma once

#include "kernel_abi/surface_form.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

[[nodiscard]] abi::SurfaceForm pack_form(const LoweredSphere& sphere);
[[nodiscard]] abi::SurfaceForm pack_form(const LoweredHugeSphere& sphere);
[[nodiscard]] abi::SurfaceForm pack_form(const LoweredPlane& plane);

/// `piece` is 0 for the side, 1 and 2 for the low and the high cap.
[[nodiscard]] abi::SurfaceForm pack_form(const LoweredQuadric& quadric, int piece);

}  // namespace packtrace
