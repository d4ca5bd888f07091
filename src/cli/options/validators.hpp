#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace packtrace::cli {

/// Whether `text` is as many whole numbers as `numbers` has room for, with separators between.
[[nodiscard]] bool parse_numbers(std::string_view text, char separator, std::span<int> numbers);

/// What `text` stands for, a number such as 0.004 or a fraction such as 1/255: finite and >= 0.
/// Nothing where it is neither.
[[nodiscard]] std::optional<double> parse_fraction(std::string_view text);

/// `accepts` tells whether a text is good, `wanted` what it should be. The help shows no more than
/// the option's own words.
[[nodiscard]] CLI::Validator validator(std::function<bool(const std::string&)> accepts,
                                       std::string wanted);

// CLI11's own ranges let NaN pass and name their bounds with forty digits.

/// A finite number >= 0.
[[nodiscard]] CLI::Validator non_negative_number();
/// What parse_fraction() takes.
[[nodiscard]] CLI::Validator non_negative_fraction();
/// A finite number > 0.
[[nodiscard]] CLI::Validator positive_number();
/// A number from 0 to 1.
[[nodiscard]] CLI::Validator share();
/// A whole number from `least` to `most`.
[[nodiscard]] CLI::Validator whole_number(int least, int most);
/// The name of a file: not empty, as of a shell's variable that is not set.
[[nodiscard]] CLI::Validator file_name();
/// The same, and not -, where standard output has something else.
[[nodiscard]] CLI::Validator own_file_name();
[[nodiscard]] CLI::Validator folder_name();
/// One of a few words, which shells offer.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);
/// One of more words than fit on a line: says which may be meant, and `wanted` where all are named.
[[nodiscard]] CLI::Validator one_of_many(std::vector<std::string> words, std::string wanted);
/// Takes any text: shells offer these words, and who reads the option says what is wrong.
[[nodiscard]] CLI::Validator offers(const std::vector<std::string>& words);
/// The words of an option that is checked by one_of(), one_of_many() or offers(); none for any
/// other.
[[nodiscard]] std::vector<std::string> offered_words(CLI::Option& option);

}  // namespace packtrace::cli
