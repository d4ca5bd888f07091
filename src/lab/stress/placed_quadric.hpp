#pragma once

#include <functional>

#include "lab/stress/stress_family.hpp"

namespace packtrace::lab {

[[nodiscard]] Mat4 any_turn(StressRandom& random);

/// Turned, stretched along its axes, turned again and moved.
[[nodiscard]] Mat4 any_placement(StressRandom& random, const Vec3& stretch, const Vec3& to);

[[nodiscard]] Vec3 any_stretch(StressRandom& random, double least);

[[nodiscard]] Vec3 to_world(const Mat4& m, const Vec3& own);

/// A placed quadric and a source of rays in its own space, which are taken to the world.
[[nodiscard]] StressCase placed(const Quadric& quadric, const Mat4& transform,
                                std::function<StressRay(StressRandom&)> own_ray);

}  // namespace packtrace::lab
