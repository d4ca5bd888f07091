#pragma once

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

#include <string>

namespace packtrace {

/// The scene in the scene language (docs/scene.md). Reading it gives the same scene, number for
/// number: they are written in the shortest form that reads back as the same double. Only an
/// object without a name gets one ("sphere 1"), and a plane without a checker the axes of
/// plane_axes(). What objects share under one material name is written once; an object whose
/// material differs from the first of its name gives its own keys beside the name. Throws
/// SceneError as validate() does, and for a scene of more keys or bytes than a scene file may have.
[[nodiscard]] PACKTRACE_API std::string scene_text(const Scene& scene);

}  // namespace packtrace
