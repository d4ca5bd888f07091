#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

// A scene's text before its meaning: where it comes from, whether it is text at all, and how a
// message names a place in it.
namespace packtrace::language {

/// The longest scene file and the longest line in one, bytes. Far above any scene of use, and
/// low enough that whatever is handed in by mistake is refused at once.
inline constexpr std::size_t longest_file = std::size_t{1} << 30u;
inline constexpr std::size_t longest_line = std::size_t{1} << 20u;

/// The most keys in a scene file. A tree takes far more memory than its text.
inline constexpr std::size_t most_keys = 8'000'000;

/// A place in a scene file; line and column count from 1, columns in bytes.
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

/// A scene file's bytes; no more are read than tell that it is longer than a scene may be.
/// Throws SceneError for a file that can't be read.
[[nodiscard]] std::string load_text(const std::filesystem::path& file);

/// The same of a stream; `name` stands for it in messages.
[[nodiscard]] std::string load_text(std::istream& in, const std::string& name);

/// Throws SceneError for what can't be a scene's text: too long, empty or binary.
void check_text(const Source& source);

}  // namespace packtrace::language
