#pragma once

#include <packtrace/explain.hpp>

#include "dispatch/kernels.hpp"
#include "lab/harness/ray_trees.hpp"
#include "lab/stress/stress_measure.hpp"

namespace packtrace::lab {

/// Pixels of the scenes that measures of whole ray trees render.
inline constexpr int measure_edge = 16;

/// Calls `take(tree)` with the ray tree of each pixel of a scene, row by row, but of no more than
/// `most`, as packets of `Real` trace it with SelfHits::exact.
template <class Real, class Take>
void for_each_tree(const Scene& scene, const StressSubject& subject, int most, const Take& take)
{
    const Accuracy accuracy =
        sizeof(Real) == sizeof(float) ? subject.options.accuracy : Accuracy::fast;
    const auto trees =
        packet_trees<Real>(scene, lower(scene, accuracy, SelfHits::exact), kernels_of(subject.isa));
    for (int pixel = 0; pixel < scene.width * scene.height && pixel < most; ++pixel)
        take(trees(pixel % scene.width, pixel / scene.width));
}

/// A camera at `org` whose picture of measure_edge pixels a side is `spread` wide at distance 1.
[[nodiscard]] inline Camera measure_camera(const Vec3& org, const Vec3& towards, double spread)
{
    Camera camera;
    camera.position = org;
    camera.rotation = look_at(org, org + towards, Vec3(towards.y, towards.z, -towards.x));
    camera.viewport = Vec2(spread);
    camera.pixel_sample = Vec2(0.5);
    return camera;
}

}  // namespace packtrace::lab
