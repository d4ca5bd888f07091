#pragma once

#include <vector>

#include "lab/stress/stress_family.hpp"
#include "lab/truth/expected_hit.hpp"

namespace packtrace::lab {

/// What is left of a sphere for a quick test in double that no line near it fails.
struct SphereScreen {
    Vec3 center{0.0};
    double radius = -1.0;  ///< below 0: no sphere, or a placed one
    double slack = 0.0;    ///< by which it is widened
};

/// Rays of one scene with all that is known of them.
struct StressGroup {
    Scene scene;
    std::vector<WideSurface> surfaces;
    std::vector<SphereScreen> screens;
    std::vector<StressRay> rays;
    std::vector<Expected> expected;  ///< by ray

    /// All hits of a ray, and what it nearly hits. Among many objects, those up to the first that
    /// is beyond doubt.
    [[nodiscard]] std::vector<TrueHit> hits_of(const StressRay& ray) const;
};

/// A scene as its truth sees it.
[[nodiscard]] StressGroup stress_group(Scene scene);

/// The same scenes and rays whatever else is run: they follow from seed and family alone.
template <class Real>
[[nodiscard]] std::vector<StressGroup> make_groups(const StressFamily& family, std::uint64_t seed,
                                                   int rays);

}  // namespace packtrace::lab
