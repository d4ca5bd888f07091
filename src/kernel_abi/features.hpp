#pragma once

#include <cstddef>

namespace packtrace::abi {

/// What a scene uses that kernels may be compiled without. Kernels are compiled for feature sets,
/// and have no branch, no array and no pass for what theirs lacks.
struct Features {
    bool quadrics = false;  ///< surfaces other than spheres and planes
    bool colored = false;   ///< children whose weight differs from channel to channel
    bool glass = false;     ///< refracted rays, or shadows that let light through
    bool probe = false;     ///< reports of single rays to TileJob::probe
    /// Rays in single precision are decided by certain tests and refined in double.
    bool exact = false;
};

/// A feature set that kernels are compiled for.
struct FeatureSet {
    const char* name;
    Features features;
};

/// A scene runs the first compiled in that covers it. Which features have a set of their own is
/// measured: results/feature_sets.json.
inline constexpr FeatureSet feature_sets[] = {
    {"spheres", {}},
    {"general", {.quadrics = true, .colored = true, .glass = true}},
    {"probe", {.quadrics = true, .colored = true, .glass = true, .probe = true}},
};
inline constexpr int feature_set_count = sizeof(feature_sets) / sizeof(FeatureSet);
/// Renders every scene.
inline constexpr int general_set = feature_set_count - 2;
/// Renders every scene, and tells of its rays.
inline constexpr int probe_set = feature_set_count - 1;

/// A probe is never chosen for a scene that does not ask for it.
constexpr bool covers(Features set, Features needed)
{
    return (set.quadrics || !needed.quadrics) && (set.colored || !needed.colored) &&
           (set.glass || !needed.glass) && set.probe == needed.probe && set.exact == needed.exact;
}

/// What of a set makes a difference to how rays find objects: kernels share that code.
constexpr Features tree_features(Features set)
{
    return {.quadrics = set.quadrics, .exact = set.exact};
}

/// A set for rays in the other way of deciding hits.
constexpr Features with_exact(Features set, bool exact)
{
    set.exact = exact;
    return set;
}

/// How many numbers a ray's weight takes.
constexpr std::size_t weight_channels(Features set)
{
    return set.colored ? 3 : 1;
}

}  // namespace packtrace::abi
