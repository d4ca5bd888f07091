#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// The glass objects that hold the eye, in the order in which they are left going `forward`, the
/// first left innermost; at equal distance the lower object number. At most glass_depth.
[[nodiscard]] std::vector<std::int32_t> glass_around(const Vec3& eye, const Vec3& forward,
                                                     const LoweredScene& lowered);

}  // namespace packtrace
