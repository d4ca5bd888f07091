#pragma once

namespace packtrace::abi {

/// What a scene uses. Kernels are compiled for feature sets, and have no branch, no array and
/// no pass for what theirs lacks.
struct Features {
    bool quadrics = false;  ///< surfaces other than spheres and planes
    bool glass = false;     ///< refracted rays, or shadows that let light through
    bool probe = false;     ///< reports of single rays to TileJob::probe
};

/// The feature sets compiled in; a scene runs the first that covers it.
inline constexpr Features feature_sets[] = {
    {.quadrics = false, .glass = false},
    {.quadrics = true, .glass = false},
    {.quadrics = true, .glass = true},
    {.quadrics = true, .glass = true, .probe = true},
};
inline constexpr int feature_set_count = 4;

/// A probe is never chosen for a scene that does not ask for it.
constexpr bool covers(Features set, Features needed)
{
    return (set.quadrics || !needed.quadrics) && (set.glass || !needed.glass) &&
           set.probe == needed.probe;
}

/// What of a set makes a difference to how rays find objects: kernels share that code.
constexpr Features tree_features(Features set)
{
    return {.quadrics = set.quadrics};
}

}  // namespace packtrace::abi
