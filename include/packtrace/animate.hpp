#pragma once

#include <packtrace/camera.hpp>
#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

namespace packtrace {

/// Returns the camera of one frame of the scene's animation. Viewport, fov and pixel sample are
/// taken from the scene's camera.
///
/// Orbit: the scene's camera first looks at the centre; frame f of n rotates it rigidly about the
/// axis by degrees * f / n. So a full turn loops without showing its first frame twice.
///
/// Keys: position, look_at and up each follow the Catmull-Rom curve whose knots are the keys'
/// frames. The curve passes through every key, its speed is continuous, and two keys give a
/// straight line. The camera rests before the first key and after the last.
///
/// Throws SceneError if validate() would reject the animation. Throws std::invalid_argument if the
/// scene has no animation, if `frame` is not in 0 … frames - 1, and if the keys lead the camera
/// through its look_at or let it look straight along its up.
[[nodiscard]] PACKTRACE_API Camera camera_at(const Scene& scene, int frame);

}  // namespace packtrace
