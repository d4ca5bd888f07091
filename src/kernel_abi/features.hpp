#pragma once

#include <cstddef>

namespace packtrace::abi {

/// Features of a scene that kernels may be compiled without. A kernel is compiled for one feature
/// set and has no branch, array or pass for the features that the set lacks.
struct Features {
    bool quadrics = false;  ///< surfaces other than spheres and planes
    bool colored = false;   ///< child rays whose weight differs between channels
    bool glass = false;     ///< refracted rays, or shadows that transmit light
    bool probe = false;     ///< records single rays for TileJob::probe
    /// Exact mode: rays in single precision are tested with error bounds, and hits are refined in
    /// double.
    bool exact = false;
};

/// A feature set that kernels are compiled for.
struct FeatureSet {
    const char* name;
    Features features;
};

/// A scene is rendered by the first compiled set that covers it. results/feature_sets.json has the
/// measurements that chose these sets.
inline constexpr FeatureSet feature_sets[] = {
    {"spheres", {}},
    {"general", {.quadrics = true, .colored = true, .glass = true}},
    {"probe", {.quadrics = true, .colored = true, .glass = true, .probe = true}},
};
inline constexpr int feature_set_count = sizeof(feature_sets) / sizeof(FeatureSet);
/// Renders every scene.
inline constexpr int general_set = feature_set_count - 2;
/// Renders every scene and records its rays.
inline constexpr int probe_set = feature_set_count - 1;

/// A set with a probe is chosen only for a scene that asks for one.
constexpr bool covers(Features set, Features needed)
{
    return (set.quadrics || !needed.quadrics) && (set.colored || !needed.colored) &&
           (set.glass || !needed.glass) && set.probe == needed.probe && set.exact == needed.exact;
}

/// The features that affect how rays find objects. Sets that agree in these share that code.
constexpr Features tree_features(Features set)
{
    return {.quadrics = set.quadrics, .exact = set.exact};
}

/// The same set with `exact` replaced.
constexpr Features with_exact(Features set, bool exact)
{
    set.exact = exact;
    return set;
}

/// How many numbers the weight of a ray has.
constexpr std::size_t weight_channels(Features set)
{
    return set.colored ? 3 : 1;
}

}  // namespace packtrace::abi
