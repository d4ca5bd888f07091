#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/stress_random.hpp"
#include "study/wide_truth.hpp"

namespace packtrace::study {

/// A scene and a source of rays that are hard on it.
struct StressCase {
    Scene scene;
    std::function<StressRay(StressRandom&)> ray;
};

/// Extreme rays of one kind.
struct StressFamily {
    std::string name;
    std::string what;
    std::function<StressCase(StressRandom&)> make;
};

/// All of them, in the order they are shown.
[[nodiscard]] const std::vector<StressFamily>& stress_families();

[[nodiscard]] std::vector<StressFamily> sphere_families();
[[nodiscard]] std::vector<StressFamily> plane_families();
[[nodiscard]] std::vector<StressFamily> quadric_families();
[[nodiscard]] std::vector<StressFamily> scene_families();

[[nodiscard]] StressRay ray_towards(const Vec3& org, const Vec3& target);
[[nodiscard]] Object sphere_object(const Vec3& center, double radius);
[[nodiscard]] Object plane_object(const Vec3& point, const Vec3& normal);

/// Any unit vector across `v`.
[[nodiscard]] Vec3 across(StressRandom& random, const Vec3& v);

/// The scene's places, and a ray, as numbers of `Real`: what the truth and the kernels share.
template <class Real>
void round_to_precision(Scene& scene);
template <class Real>
void round_to_precision(StressRay& ray);

}  // namespace packtrace::study
