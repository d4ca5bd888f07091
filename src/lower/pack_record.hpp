#pragma once

#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"

// Lowered records in the kernels' precision: every value is rounded once, from double.
namespace packtrace {

template <class Real>
void round_to(Real (&to)[3], const Vec3& from)
{
    for (int axis = 0; axis < 3; ++axis)
        to[axis] = static_cast<Real>(from[axis]);
}

/// How far rounding to Real moves a sphere's centre, at most.
template <class Real>
[[nodiscard]] double center_error(const LoweredSphere& sphere);

template <class Real>
[[nodiscard]] abi::AnchoredSphere<Real> pack_anchored(const LoweredAnchoredSphere& sphere);

template <class Real>
[[nodiscard]] abi::PlaneRecord<Real> pack_plane(const LoweredPlane& plane);

template <class Real>
[[nodiscard]] abi::QuadricRecord<Real> pack_quadric(const LoweredQuadric& quadric);

template <class Real>
[[nodiscard]] abi::MaterialRecord<Real> pack_material(const LoweredMaterial& material);

}  // namespace packtrace
