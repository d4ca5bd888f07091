#pragma once

#include <string>

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

namespace packtrace {

/// The scene in the scene language (docs/scene.md). Reading it gives the same scene: numbers are
/// written in the shortest form that reads back as the same double. What objects share under
/// one material name is written once; a material that differs from the first of its name, as
/// that of a plane with squares does, is written with its object and loses the name. Throws
/// std::invalid_argument for what the language can't say: quotes or control characters in names,
/// a material of another model than the scene's, a colour outside 0 to 1.
[[nodiscard]] PACKTRACE_API std::string scene_text(const Scene& scene);

}  // namespace packtrace
