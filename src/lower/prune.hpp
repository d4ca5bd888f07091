#pragma once

#include "lower/lowered_scene.hpp"
#include <packtrace/traversal.hpp>

#include <cstddef>
#include <string>
#include <vector>

// Pruning: a scene without what cannot change its picture (docs/features.md).
namespace packtrace {

/// Finds the features that a scene's materials and objects use, whatever its lights and depth are.
void find_features(LoweredScene& lowered);

/// Removes surfaces that are equal to an earlier one of their kind: at equal t the lower number is
/// hit, so they are never seen. In scenes with glass nothing is removed, because light passes
/// through all of them. Returns how many surfaces were removed.
std::size_t remove_duplicates(LoweredScene& lowered);

/// Something that was pruned from a picture's scene, and the reason.
struct LeftOut {
    std::string what;
    std::string why;
};

/// Removes from a scene what cannot change a bit of its picture, and narrows its features to those
/// that remain: dark lights, duplicates, reflections beyond the depth, shadows without a caster,
/// normals that no light needs. For pictures only: a caller's own rays may use any of it.
std::vector<LeftOut> prune(LoweredScene& lowered);

/// All that the kernels chosen for a scene do without, in the order of a frame's stages. `lowered`
/// has been pruned.
[[nodiscard]] std::vector<LeftOut> unused_features(const LoweredScene& lowered,
                                                   Traversal traversal);

}  // namespace packtrace
