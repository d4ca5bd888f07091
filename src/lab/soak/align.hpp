#pragma once

#include <packtrace/scene.hpp>

namespace packtrace::lab {

/// The step of a grid that suits a scene's size: a power of two.
[[nodiscard]] double grid_step(const Scene& scene);

/// The nearest multiple of the step, component by component.
[[nodiscard]] Vec3 on_grid(const Vec3& value, double step);

/// Rounds what places a scene's objects, lights and eye to a coarse grid, and what turns them to
/// the axes and the diagonals between them: much of it then touches, coincides, or runs parallel.
void align(Scene& scene);

}  // namespace packtrace::lab
