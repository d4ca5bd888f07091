#pragma once

#include <span>

#include <packtrace/animation.hpp>

namespace packtrace {

/// The pose at `frame` on the curve through at least two keys in rising frame order.
[[nodiscard]] CameraKey pose_between(std::span<const CameraKey> keys, int frame);

}  // namespace packtrace
