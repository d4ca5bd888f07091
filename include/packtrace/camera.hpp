#pragma once

#include <packtrace/export.hpp>
#include <packtrace/vec.hpp>

#include <optional>

namespace packtrace {

/// Pinhole camera after Gambetta's pseudocode (note 001): the ray of canvas point (x, y) is
/// `position + t * rotation * (x * Vw / Cw, y * Vh / Ch, d)`. Its direction is not normalised.
struct Camera {
    Vec3 position{0.0};
    /// Its columns are the camera's right, up and forward axes in world space.
    Mat3 rotation{1.0};
    /// Viewport width and height, scene units. Ignored if `fov` is set.
    Vec2 viewport{1.0, 1.0};
    /// Distance from the eye to the projection plane, scene units.
    double distance = 1.0;
    /// Full vertical angle of view, degrees. If set, the viewport has the picture's aspect ratio.
    std::optional<double> fov = {};
    /// Position of a pixel's only sample, measured from its left and top edges, each in [0, 1].
    Vec2 pixel_sample{0.0, 1.0};
};

/// The direction of a camera ray is `forward + x * right + y * up`, with
/// x = i + sample.x - width / 2 for column i and y = height / 2 - j - sample.y for row j.
struct CameraBasis {
    Vec3 origin{0.0};
    Vec3 right{0.0};    ///< change of direction per pixel to the right
    Vec3 up{0.0};       ///< change of direction per pixel upwards
    Vec3 forward{0.0};  ///< direction through the middle of the canvas
};

/// Maps the camera's viewport to a canvas of `width` by `height` pixels.
[[nodiscard]] PACKTRACE_API CameraBasis camera_basis(const Camera& camera, int width, int height);

/// The rotation whose forward axis points from `position` to `target` and whose right axis is
/// perpendicular to `up` (left-handed). Throws std::invalid_argument if the view direction is zero
/// or parallel to `up`.
[[nodiscard]] PACKTRACE_API Mat3 look_at(const Vec3& position, const Vec3& target, const Vec3& up);

}  // namespace packtrace
