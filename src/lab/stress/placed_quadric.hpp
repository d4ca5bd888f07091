#pragma once

#include "lab/stress/stress_family.hpp"
#include <packtrace/build.hpp>

#include <functional>
#include <vector>

// Quadrics of a kind, points on them, and random placements.
namespace packtrace::lab {

/// All but `general`.
inline const std::vector<QuadricKind> every_kind = {
    QuadricKind::ellipsoid,  QuadricKind::cylinder,    QuadricKind::cone,
    QuadricKind::paraboloid, QuadricKind::hyperboloid, QuadricKind::hyperboloid2,
    QuadricKind::saddle};

/// A point on the surface in own space, within a few units of its middle.
[[nodiscard]] Vec3 own_surface_point(StressRandom& random, QuadricKind kind);

[[nodiscard]] Mat4 any_turn(StressRandom& random);

/// Turned, stretched along the axes, turned again and moved.
[[nodiscard]] Mat4 any_placement(StressRandom& random, const Vec3& stretch, const Vec3& to);

/// The identity half of the time, else any_placement() with stretches from `least` to 1 and a move
/// of up to `off` along each axis.
[[nodiscard]] Mat4 sometimes_placed(StressRandom& random, double least, double off);

[[nodiscard]] Vec3 any_stretch(StressRandom& random, double least);

[[nodiscard]] Vec3 to_world(const Mat4& m, const Vec3& own);

/// A placed quadric with rays that `own_ray` makes in own space.
[[nodiscard]] StressCase placed(const Quadric& quadric, const Mat4& transform,
                                std::function<StressRay(StressRandom&)> own_ray);

}  // namespace packtrace::lab
