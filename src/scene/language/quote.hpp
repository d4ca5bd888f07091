#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

// How messages quote the user's text, and which word they suggest instead.
namespace packtrace::language {

/// Makes `text` safe for one line of a terminal: control characters, invisible characters and bytes
/// that are not UTF-8 become \xNN.
[[nodiscard]] std::string escape(std::string_view text);

/// `text` in single quotes for a message. It is escaped, and truncated after a few dozen bytes.
[[nodiscard]] std::string quote(std::string_view text);

/// The word of `known` that was probably meant by `word`: at most two letters are changed,
/// inserted, missing or swapped with their neighbour. Empty if there is none.
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            std::span<const std::string_view> known);
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            const std::vector<std::string>& known);

/// "did you mean 'radius'?", or "use one of: a, b, c" if no word is near.
[[nodiscard]] std::string suggest(std::string_view word, std::span<const std::string_view> known);

/// "a, b, c".
[[nodiscard]] std::string join(std::span<const std::string_view> words);

}  // namespace packtrace::language
