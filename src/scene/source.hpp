#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace packtrace::reader {

/// A place in a scene file; line and column count from 1, columns in bytes. A file is far
/// smaller than 4 GiB (see check_text.hpp).
struct Position {
    std::uint32_t line = 1;
    std::uint32_t column = 1;

    [[nodiscard]] static Position of(std::size_t line, std::size_t column)
    {
        return {static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(column)};
    }
};

/// The text of a scene and the name it goes by in messages.
struct Source {
    std::string name;
    std::string_view text;
    std::function<void(const std::string&)> take_warning = {};  ///< may be empty
};

/// Throws SceneError `name:line:column: message`.
[[noreturn]] void fail(const Source& source, Position at, const std::string& message);

/// Passes on `name:line:column: message`, if anybody takes it.
void warn(const Source& source, Position at, const std::string& message);

}  // namespace packtrace::reader
