#pragma once

#include <packtrace/surface.hpp>

#include "lab/stress/stress_random.hpp"

namespace packtrace::lab {

/// The quadric of a kind with its coefficients; not for `general`.
[[nodiscard]] Quadric quadric_of(QuadricKind kind);

/// A point of its surface in its own space, within a few units of its middle.
[[nodiscard]] Vec3 own_surface_point(StressRandom& random, QuadricKind kind);

}  // namespace packtrace::lab
