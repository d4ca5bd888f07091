#pragma once

#include <packtrace/surface.hpp>

namespace packtrace {

/// The unit normal of a polygon placed by a transform of this linear part, on the side that the
/// transform puts the own one's on. Rounded once where the transform flattens the polygon, as
/// double loses digits of it there.
[[nodiscard]] Vec3 placed_normal(const Polygon& polygon, const Mat3& linear);

}  // namespace packtrace
