#pragma once

#include <packtrace/image.hpp>
#include <packtrace/scene.hpp>
#include "reference/vec3.hpp"

namespace packtrace::reference {

/// Note 001's canvas and viewport, with the rotation already applied.
template <class Real>
struct Canvas {
    Vec3<Real> position;  ///< of the camera
    Vec3<Real> right;     ///< rotation * (Vw/Cw, 0, 0)
    Vec3<Real> up;        ///< rotation * (0, Vh/Ch, 0)
    Vec3<Real> forward;   ///< rotation * (0, 0, d)
    /// Canvas coordinates of the sample in column 0 and row 0.
    Real first_x{};
    Real first_y{};
    Real half_width{};  ///< of the canvas, pixels
    Real half_height{};

    explicit Canvas(const Scene& scene)
    {
        const CameraBasis basis = camera_basis(scene.camera, scene.width, scene.height);
        position = Vec3<Real>(basis.origin);
        right = Vec3<Real>(basis.right);
        up = Vec3<Real>(basis.up);
        forward = Vec3<Real>(basis.forward);
        const Vec2 sample = scene.camera.pixel_sample;
        half_width = static_cast<Real>(scene.width) / 2;
        half_height = static_cast<Real>(scene.height) / 2;
        first_x = static_cast<Real>(sample.x) - half_width;
        first_y = half_height - static_cast<Real>(sample.y);
    }

    /// camera.rotation * (x*Vw/Cw, y*Vh/Ch, d) for the pixel in column `i` and row `j`.
    [[nodiscard]] Vec3<Real> canvas_to_viewport(int i, int j) const
    {
        const Real x = first_x + static_cast<Real>(i);
        const Real y = first_y - static_cast<Real>(j);
        return x * right + y * up + forward;
    }

    /// The same through `sample` of the pixel, as Camera::pixel_sample has it.
    [[nodiscard]] Vec3<Real> canvas_to_viewport(int i, int j, const Vec2& sample) const
    {
        const Real x = static_cast<Real>(sample.x) - half_width + static_cast<Real>(i);
        const Real y = half_height - static_cast<Real>(sample.y) - static_cast<Real>(j);
        return x * right + y * up + forward;
    }
};

template <class Real>
void put_pixel(Image<Real>& image, int i, int j, const Color<Real>& color)
{
    Real* pixel = image.pixel(i, j);
    pixel[0] = color.x;
    pixel[1] = color.y;
    pixel[2] = color.z;
}

}  // namespace packtrace::reference
