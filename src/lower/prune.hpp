#pragma once

#include "lower/lowered_scene.hpp"
#include <packtrace/traversal.hpp>

#include <cstddef>
#include <string>
#include <vector>

// What a picture needs of its scene, and what it does without (docs/features.md).
namespace packtrace {

/// Finds what of its features a scene uses, whatever its lights and depth are.
void find_features(LoweredScene& lowered);

/// Removes surfaces that are an earlier one of their kind once more: at equal t the lower number is
/// hit, so they are never seen. Where light passes through objects each counts, and nothing is
/// removed. Returns how many surfaces went.
std::size_t remove_duplicates(LoweredScene& lowered);

/// Something that a picture does without, and why it may.
struct LeftOut {
    std::string what;
    std::string why;
};

/// Takes out of a scene what can't change a bit of its picture, and narrows its features to what
/// is left: dark lights, objects in another's very place, reflections that no depth allows,
/// shadows that nothing casts, hits that nothing would be done with. For pictures alone: rays of
/// the caller's own may ask for all of it.
std::vector<LeftOut> prune(LoweredScene& lowered);

/// Everything that the kernels chosen for a scene are without, in the order of a frame's stages.
/// `lowered` is what prune() left.
[[nodiscard]] std::vector<LeftOut> unused_features(const LoweredScene& lowered,
                                                   Traversal traversal);

}  // namespace packtrace
