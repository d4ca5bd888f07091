#pragma once

#include "kernel_abi/shapes.hpp"
#include "lower/lowered_scene.hpp"
#include "scene/moved_shape.hpp"

#include <span>

namespace packtrace {

/// Puts the surfaces of some objects of the scene, each named once, to where they are now. `index`
/// is that of the scene as packed. False, and `lowered` is of no more use, where a hierarchy can't
/// go on with an object: its surface is of another kind now, or is or was none that a hierarchy
/// holds.
[[nodiscard]] bool move_objects(const Scene& scene, std::span<const MovedShape> moved,
                                const abi::SurfaceIndex* index, LoweredScene& lowered);

}  // namespace packtrace
