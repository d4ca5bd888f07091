#pragma once

#include <packtrace/scene.hpp>

#include "lab/stress/stress_random.hpp"

namespace packtrace::lab {

/// A small scene of anything the language can say: every model, kind and placement, glass, mirrors,
/// squares, twins and bodies that touch, of any size from 1e-6 to 1e6. The language may still
/// refuse it, as where a quadric has no surface.
[[nodiscard]] Scene soak_scene(StressRandom& random);

/// A point that is on the object's surface, or next to it.
[[nodiscard]] Vec3 point_near(StressRandom& random, const Object& object);

}  // namespace packtrace::lab
