#pragma once

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>
#include <packtrace/validate.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace packtrace {

/// Is called with one line, `file:line:column: what`, for what a reader had to mend.
using TakeWarning = std::function<void(const std::string& line)>;

/// Reads a scene file (docs/scene.md). Throws SceneError, `file:line:column: what, why, what to
/// do`, for unreadable or wrong input. Values are checked as validate() checks them.
[[nodiscard]] PACKTRACE_API Scene read_scene(const std::filesystem::path& file,
                                             const TakeWarning& warn = {});

/// Reads a scene from text; `name` stands for the file in messages.
[[nodiscard]] PACKTRACE_API Scene parse_scene(std::string_view text, const std::string& name,
                                              const TakeWarning& warn = {});

}  // namespace packtrace
