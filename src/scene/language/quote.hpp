#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

// How messages show what a user wrote, and what may have been meant.
namespace packtrace::language {

/// `text` fit for one line of a terminal: control characters, characters that nobody sees and bytes
/// that are not UTF-8 become \xNN.
[[nodiscard]] std::string escape(std::string_view text);

/// `text` in single quotes for a message: escaped, and cut after a few dozen bytes.
[[nodiscard]] std::string quote(std::string_view text);

/// The word of `known` that `word` is most likely a slip of: at most two letters changed, put
/// in, left out or swapped with their neighbour. Empty when there is none.
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            std::span<const std::string_view> known);
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            const std::vector<std::string>& known);

/// "did you mean 'radius'?", or "use one of: a, b, c" when nothing is near.
[[nodiscard]] std::string suggest(std::string_view word, std::span<const std::string_view> known);

/// "a, b, c".
[[nodiscard]] std::string join(std::span<const std::string_view> words);

}  // namespace packtrace::language
