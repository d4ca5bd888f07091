#pragma once

#include <cmath>

#include "kernel_abi/stiff.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Whether a surface is tested in double although Real is single.
template <class Real, class Surface>
[[nodiscard]] bool goes_to_stiff(const Surface& surface)
{
    return sizeof(Real) == sizeof(float) && surface.stiff;
}

[[nodiscard]] abi::StiffObject pack_stiff_object(const LoweredSphere& sphere);
[[nodiscard]] abi::StiffObject pack_stiff_object(const LoweredHugeSphere& sphere);
[[nodiscard]] abi::StiffObject pack_stiff_object(const LoweredPlane& plane);
[[nodiscard]] abi::StiffObject pack_stiff_object(const LoweredQuadric& quadric);

}  // namespace packtrace
