#pragma once

#include "ray_set.hpp"
#include <packtrace/scene.hpp>

#include <cstddef>

namespace packtrace::peers {

/// How two sides' closest hits of the same rays differ. The true distance in double precision
/// decides which side is right. Hits of spheres with a radius above 100, such as note 001's ground,
/// are counted separately: single precision has too few digits for them.
struct Agreement {
    std::size_t rays = 0;
    std::size_t hit_by_both = 0;
    /// Different objects, or hit and miss, with true distances that differ by more than 1e-4 of
    /// them.
    std::size_t objects_differ = 0;
    std::size_t objects_differ_on_ground = 0;  ///< not in the count above
    std::size_t ties = 0;                      ///< different objects at the same distance
    std::size_t ours_wrong = 0;                ///< of all that differ, with the ground
    std::size_t theirs_wrong = 0;              ///< the same
    /// Same object, with t that differ by more than 1e-4 of them.
    std::size_t distances_differ = 0;
    std::size_t distances_differ_on_ground = 0;
    double our_largest_error = 0.0;    ///< of |t - true t| / true t, without hits of the ground
    double their_largest_error = 0.0;  ///< the same
};

[[nodiscard]] Agreement compare_closest(const Scene& scene, const RaySet& rays, const Hits& ours,
                                        const Hits& theirs);

/// Rays that one side finds occluded and the other does not.
[[nodiscard]] std::size_t count_occlusion_differences(const Hits& ours, const Hits& theirs);

}  // namespace packtrace::peers
