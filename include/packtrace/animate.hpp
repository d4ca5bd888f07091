#pragma once

#include <packtrace/camera.hpp>
#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

namespace packtrace {

/// The camera of one frame of the scene's animation; viewport, fov and pixel sample are those of
/// the scene's camera.
///
/// Orbit: at frame f of n the camera, turned to look at the centre, is turned rigidly about the
/// axis by degrees * f / n, so that a full turn loops without showing its first frame twice. Keys:
/// position, look_at and up each follow the Catmull-Rom curve whose knots are the keys' frames:
/// it passes through every key, its speed changes nowhere by a jump, and two keys give a
/// straight line. Before the first key and after the last the camera rests.
///
/// Throws SceneError where validate() would for the animation, and std::invalid_argument when the
/// scene has no animation or `frame` is not one of its frames, and when keys lead the camera
/// through its own look_at or straight along its up.
[[nodiscard]] PACKTRACE_API Camera camera_at(const Scene& scene, int frame);

}  // namespace packtrace
