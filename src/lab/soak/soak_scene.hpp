#pragma once

#include "lab/stress/stress_random.hpp"
#include <packtrace/scene.hpp>

// Random scenes (soak_scene.cpp), and how to align them to a grid (align.cpp).
namespace packtrace::lab {

/// A small random scene with anything that the scene language has: every model, kind and placement,
/// glass, mirrors, checkers, twins and bodies that touch, of any size from 1e-6 to 1e6. The
/// language may still refuse it, for instance if a quadric has no surface.
[[nodiscard]] Scene soak_scene(StressRandom& random);

/// A point on the object's surface, or near it.
[[nodiscard]] Vec3 point_near(StressRandom& random, const Object& object);

/// The step of a grid for a scene's size: a power of two.
[[nodiscard]] double grid_step(const Scene& scene);

/// The nearest multiple of the step, component by component.
[[nodiscard]] Vec3 on_grid(const Vec3& value, double step);

/// Rounds the positions of a scene's objects, lights and camera to a coarse grid, and their
/// directions to the axes and the diagonals between them. Many things then touch, coincide or are
/// parallel.
void align(Scene& scene);

}  // namespace packtrace::lab
