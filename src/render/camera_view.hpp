#pragma once

#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"
#include <packtrace/scene.hpp>

#include <cmath>

namespace packtrace {

/// The scene's camera and canvas, rounded to the kernels' precision. Rays go through `sample` of
/// each pixel.
template <class Real>
[[nodiscard]] abi::CameraView<Real> camera_view(const Scene& scene, const LoweredScene& lowered,
                                                const Vec2& sample)
{
    const CameraBasis basis = camera_basis(scene.camera, scene.width, scene.height);
    abi::CameraView<Real> view;
    for (int axis = 0; axis < 3; ++axis) {
        view.origin[axis] = static_cast<Real>(basis.origin[axis]);
        view.right[axis] = static_cast<Real>(basis.right[axis]);
        view.up[axis] = static_cast<Real>(basis.up[axis]);
        view.forward[axis] = static_cast<Real>(basis.forward[axis]);
    }
    view.first_x = static_cast<Real>(sample.x - 0.5 * scene.width);
    view.first_y = static_cast<Real>(0.5 * scene.height - sample.y);
    // Packets count hits with t > t_min, the notes also those with t = t_min.
    view.t_min = std::nextafter(static_cast<Real>(lowered.camera_t_min), Real(0));
    for (std::size_t i = 0; i < lowered.eye_inside.size(); ++i)
        view.inside[i] = lowered.eye_inside[i];
    return view;
}

/// As above; rays go through the scene's pixel sample.
template <class Real>
[[nodiscard]] abi::CameraView<Real> camera_view(const Scene& scene, const LoweredScene& lowered)
{
    return camera_view<Real>(scene, lowered, scene.camera.pixel_sample);
}

}  // namespace packtrace
