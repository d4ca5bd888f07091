#pragma once

#include <packtrace/animation.hpp>
#include <packtrace/camera.hpp>

namespace packtrace {

/// `start` looking at the orbit's centre, then turned about its axis by `share` of the whole.
[[nodiscard]] Camera orbit_camera(const Camera& start, const Orbit& orbit, double share);

}  // namespace packtrace
