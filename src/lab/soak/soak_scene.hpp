#pragma once

#include "lab/stress/stress_random.hpp"
#include <packtrace/scene.hpp>

// Random scenes (soak_scene.cpp), and the same with much that coincides (align.cpp).
namespace packtrace::lab {

/// A small scene of anything the language can say: every model, kind and placement, glass, mirrors,
/// squares, twins and bodies that touch, of any size from 1e-6 to 1e6. The language may still
/// refuse it, as where a quadric has no surface.
[[nodiscard]] Scene soak_scene(StressRandom& random);

/// A point that is on the object's surface, or next to it.
[[nodiscard]] Vec3 point_near(StressRandom& random, const Object& object);

/// The step of a grid that suits a scene's size: a power of two.
[[nodiscard]] double grid_step(const Scene& scene);

/// The nearest multiple of the step, component by component.
[[nodiscard]] Vec3 on_grid(const Vec3& value, double step);

/// Rounds what places a scene's objects, lights and eye to a coarse grid, and what turns them to
/// the axes and the diagonals between them: much of it then touches, coincides, or runs parallel.
void align(Scene& scene);

}  // namespace packtrace::lab
