#pragma once

#include <packtrace/scene.hpp>

#include <string>

namespace packtrace::peers {

// Both exports throw std::runtime_error for what they cannot express: models other than scratch,
// shadows that are not opaque, quadrics, polygons, checkers, transforms, coloured ambient light.

/// The scene for POV-Ray 3.7. If there are few objects, each has lights of its own colour, so that
/// its highlights are coloured as in note 001; otherwise highlights are white.
[[nodiscard]] std::string pov_scene(const Scene& scene);

/// The scene for Tachyon 0.99, whose space is left-handed, like that of packtrace.
[[nodiscard]] std::string tachyon_scene(const Scene& scene);

/// Checks a scene without its objects; returns the sum of its ambient lights.
[[nodiscard]] double checked_ambient(const Scene& scene);

/// Checks that an object is a sphere or a plane without transform and checker.
void check_object(const Object& object);

}  // namespace packtrace::peers
