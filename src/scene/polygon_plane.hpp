#pragma once

#include <packtrace/surface.hpp>

namespace packtrace {

/// The unit normal of a polygon under a transform with this linear part. It is on the side to which
/// the transform moves the polygon's own normal. If the transform flattens the polygon, double
/// loses digits, and the normal is computed in more digits and rounded once.
[[nodiscard]] Vec3 placed_normal(const Polygon& polygon, const Mat3& linear);

}  // namespace packtrace
