#pragma once

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>
#include <packtrace/validate.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace packtrace {

/// Receives each warning as one line, `file:line:column: what`. The scene is usable, but the file
/// is probably not what was intended: a rotation that the reader had to correct, a duplicate name,
/// an object or a scene with nothing to see.
using TakeWarning = std::function<void(const std::string& line)>;

/// Reads a scene file (docs/scene.md) and validates the scene as validate() does. Throws
/// SceneError, `file:line:column: what, why, what to do`, if the file cannot be read or is wrong.
[[nodiscard]] PACKTRACE_API Scene read_scene(const std::filesystem::path& file,
                                             const TakeWarning& warn = {});

/// Reads a scene from text. Messages use `name` as the name of the file.
[[nodiscard]] PACKTRACE_API Scene parse_scene(std::string_view text, const std::string& name,
                                              const TakeWarning& warn = {});

}  // namespace packtrace
