#pragma once

#include "lab/stress/stress_random.hpp"
#include "lab/truth/wide_truth.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace packtrace::lab {

/// t_max of rays without an end.
inline constexpr double no_end = std::numeric_limits<double>::infinity();

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
    /// The first scenes, if these are known ones.
    std::vector<std::function<StressCase()>> known = {};
    bool closed = false;  ///< one closed body, which endless rays leave as often as they enter it
    int scenes = 16;
    bool packets_only = false;  ///< too many objects for one after the other
};

/// All of them, in the order they are shown.
[[nodiscard]] const std::vector<StressFamily>& stress_families();

[[nodiscard]] std::vector<StressFamily> sphere_families();
[[nodiscard]] std::vector<StressFamily> plane_families();
[[nodiscard]] std::vector<StressFamily> quadric_families();
[[nodiscard]] std::vector<StressFamily> scene_families();
[[nodiscard]] std::vector<StressFamily> far_families();
[[nodiscard]] std::vector<StressFamily> touching_families();
[[nodiscard]] std::vector<StressFamily> edge_families();
[[nodiscard]] std::vector<StressFamily> polygon_families();
[[nodiscard]] std::vector<StressFamily> mixed_families();

[[nodiscard]] StressCase case_of(std::vector<Object> objects,
                                 std::function<StressRay(StressRandom&)> ray);
[[nodiscard]] StressRay ray_towards(const Vec3& org, const Vec3& target);
[[nodiscard]] Object sphere_object(const Vec3& center, double radius);
[[nodiscard]] Object plane_object(const Vec3& point, const Vec3& normal);

/// A scene of a known finding: its ray, then such as differ from it in their last digits.
[[nodiscard]] StressCase known_case(std::vector<Object> objects, const StressRay& ray);

/// Any unit vector across `v`.
[[nodiscard]] Vec3 across(StressRandom& random, const Vec3& v);

/// The scene's places, and a ray, as numbers of `Real`: what the truth and the kernels share.
template <class Real>
void round_to_precision(Scene& scene);
template <class Real>
void round_to_precision(StressRay& ray);

}  // namespace packtrace::lab
