#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace packtrace {

/// A place in a scene file; line and column count from 1, columns in bytes.
struct Position {
    std::size_t line = 1;
    std::size_t column = 1;
};

/// The text of a scene and the name it goes by in messages.
struct Source {
    std::string name;
    std::string_view text;
};

/// Throws SceneError `name:line:column: message`.
[[noreturn]] void fail(const Source& source, Position at, const std::string& message);

}  // namespace packtrace
