#pragma once

#include "lab/stress/stress_random.hpp"
#include "lab/truth/wide_truth.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace packtrace::lab {

/// t_max of infinite rays.
inline constexpr double no_end = std::numeric_limits<double>::infinity();

/// A scene and a source of rays that are difficult for it.
struct StressCase {
    Scene scene;
    std::function<StressRay(StressRandom&)> ray;
};

/// Extreme rays of one kind.
struct StressFamily {
    std::string name;
    std::string what;
    std::function<StressCase(StressRandom&)> make;
    /// Fixed cases, which replace the first scenes.
    std::vector<std::function<StressCase()>> known = {};
    bool closed = false;  ///< one closed body: infinite rays leave it as often as they enter it
    int scenes = 16;
    bool packets_only = false;  ///< too many objects for kernels without a BVH
};

/// All families, in the order in which they are shown.
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

/// The scene of an earlier finding: its ray, then rays that differ from it in their last digits.
[[nodiscard]] StressCase known_case(std::vector<Object> objects, const StressRay& ray);

/// A random unit vector perpendicular to `v`.
[[nodiscard]] Vec3 across(StressRandom& random, const Vec3& v);

/// Rounds the numbers that place a scene's objects, or a ray, to `Real`, so that the truth and the
/// kernels get the same numbers.
template <class Real>
void round_to_precision(Scene& scene);
template <class Real>
void round_to_precision(StressRay& ray);

}  // namespace packtrace::lab
