#pragma once

#include "scene/language/syntax_tree.hpp"
#include <packtrace/scene.hpp>

#include <cstddef>

// The blocks of objects and of the named materials that they use.
namespace packtrace::language {

/// Appends the objects of a file to its scene, whose illumination is known. Throws SceneError.
void read_objects(const Block& file, Scene& scene);

/// The block of an object that has been read.
[[nodiscard]] Field object_field(const Block& file, std::size_t number);

}  // namespace packtrace::language
