#pragma once

#include "ray_set.hpp"
#include <packtrace/scene.hpp>

#include <cstddef>

namespace packtrace::peers {

/// How two sides' closest hits of the same rays differ, and which side is right by the distance
/// in double precision. A sphere of radius above 100, the ground of note 001, is counted apart:
/// single precision is short of digits there.
struct Agreement {
    std::size_t rays = 0;
    std::size_t hit_by_both = 0;
    /// Other object or hit against miss, the true distances being apart by more than 1e-4 of them.
    std::size_t objects_differ = 0;
    std::size_t objects_differ_on_ground = 0;  ///< not counted in the line above
    std::size_t ties = 0;                      ///< other object, at the same distance
    std::size_t ours_wrong = 0;                ///< of those that differ, ground included
    std::size_t theirs_wrong = 0;              ///< of the same
    /// Same object, t apart by more than 1e-4 of it.
    std::size_t distances_differ = 0;
    std::size_t distances_differ_on_ground = 0;
    double our_largest_error = 0.0;    ///< |t - true t| / true t over all hits but the ground's
    double their_largest_error = 0.0;  ///< of the same
};

[[nodiscard]] Agreement compare_closest(const Scene& scene, const RaySet& rays, const Hits& ours,
                                        const Hits& theirs);

/// Rays that one side finds occluded and the other does not.
[[nodiscard]] std::size_t count_occlusion_differences(const Hits& ours, const Hits& theirs);

}  // namespace packtrace::peers
