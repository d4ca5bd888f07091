#pragma once

#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

/// A material in the kernels' precision: every value is rounded once, from double.
template <class Real>
[[nodiscard]] abi::MaterialRecord<Real> pack_material(const LoweredMaterial& material);

}  // namespace packtrace
