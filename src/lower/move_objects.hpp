#pragma once

#include "kernel_abi/shapes.hpp"
#include "lower/lowered_scene.hpp"
#include "scene/moved_shape.hpp"

#include <span>

namespace packtrace {

/// Moves the surfaces of some objects, each named once, to their new places. `index` is that of the
/// packed scene. False, with `lowered` left unusable, if the BVH cannot be refitted: an object now
/// has a surface of another kind, or it is not in the BVH before or after.
[[nodiscard]] bool move_objects(const Scene& scene, std::span<const MovedShape> moved,
                                const abi::SurfaceIndex* index, LoweredScene& lowered);

}  // namespace packtrace
