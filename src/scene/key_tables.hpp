#pragma once

#include <span>
#include <string>
#include <string_view>

namespace packtrace::language {

/// The names of the tables that describe the language: "scene", "camera", …
[[nodiscard]] std::span<const std::string_view> key_table_names();

/// A table of docs/scene.md in Markdown, made from the rows; empty for an unknown name.
[[nodiscard]] std::string key_table(std::string_view name);

}  // namespace packtrace::language
