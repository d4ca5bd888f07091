#pragma once

#include <packtrace/scene.hpp>

#include <string>

namespace packtrace::peers {

/// The scene for POV-Ray 3.7. Where there are few objects, each is lit by lights of its own
/// colour, which tints highlights as note 001 does; otherwise highlights are white.
[[nodiscard]] std::string pov_scene(const Scene& scene);

/// The scene for Tachyon 0.99, whose space is left-handed as ours is.
[[nodiscard]] std::string tachyon_scene(const Scene& scene);

// Both throw std::runtime_error for what they can't say: another illumination than scratch,
// shadows that are not opaque, quadrics, squares, transforms, coloured ambient light.

/// What both ask of a scene; the sum of its ambient lights.
[[nodiscard]] double checked_ambient(const Scene& scene);

/// The plain sphere or plane without squares that both know.
void check_object(const Object& object);

}  // namespace packtrace::peers
