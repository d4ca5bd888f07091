#pragma once

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

#include <string>

namespace packtrace {

/// Returns the scene in the scene language (docs/scene.md). The text reads back as the same scene:
/// each number has the shortest form that reads back as the same double. There are two differences:
/// an object without a name gets one ("sphere 1"), and a plane without a checker gets the axes of
/// plane_axes().
///
/// Objects whose materials have one name share its definition, which is that of the first of them.
/// An object whose material differs from it has its own keys besides the name.
///
/// Throws SceneError as validate() does, and for a scene with more keys or bytes than a scene file
/// may have.
[[nodiscard]] PACKTRACE_API std::string scene_text(const Scene& scene);

}  // namespace packtrace
