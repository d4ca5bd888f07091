#pragma once

#include "scene/language/syntax_tree.hpp"
#include <packtrace/scene.hpp>

#include <cstddef>

// Reads the blocks of objects and of the named materials that they use.
namespace packtrace::language {

/// Appends the objects of a file to `scene`, whose illumination must be set. Throws SceneError.
void read_objects(const Block& file, Scene& scene);

/// The block of the object with index `number`, for messages.
[[nodiscard]] Field object_field(const Block& file, std::size_t number);

}  // namespace packtrace::language
