#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

// The text of a scene before it is parsed: loading it, checking that it is text, and messages with
// a position in it.
namespace packtrace::language {

/// The longest scene file and the longest line, in bytes. They are far above those of useful
/// scenes, and low enough to reject a wrong file at once.
inline constexpr std::size_t longest_file = std::size_t{1} << 30u;
inline constexpr std::size_t longest_line = std::size_t{1} << 20u;

/// The largest number of keys in a scene file. A syntax tree takes far more memory than its text.
inline constexpr std::size_t most_keys = 8'000'000;

/// A position in a scene file. Lines and columns count from 1, columns in bytes.
struct Position {
    std::uint32_t line = 1;
    std::uint32_t column = 1;

    [[nodiscard]] static Position of(std::size_t line, std::size_t column)
    {
        return {static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(column)};
    }
};

/// The text of a scene, and its name in messages.
struct Source {
    std::string name;
    std::string_view text;
    std::function<void(const std::string&)> take_warning = {};  ///< may be empty
};

/// Throws SceneError `name:line:column: message`.
[[noreturn]] void fail(const Source& source, Position at, const std::string& message);

/// Calls take_warning, unless empty, with `name:line:column: message`.
void warn(const Source& source, Position at, const std::string& message);

/// Reads the bytes of a scene file. Of a file that is too long, it reads only enough to find that
/// out. Throws SceneError if the file cannot be read.
[[nodiscard]] std::string load_text(const std::filesystem::path& file);

/// Reads the bytes of a stream, likewise. Messages call it `name`.
[[nodiscard]] std::string load_text(std::istream& in, const std::string& name);

/// Throws SceneError for text that cannot be a scene: too long, empty or binary.
void check_text(const Source& source);

}  // namespace packtrace::language
