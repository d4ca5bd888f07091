#pragma once

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace packtrace::cli {

/// Reads one or more whole numbers with a separator between them. Not set for other text.
[[nodiscard]] std::optional<std::vector<int>> parse_numbers(std::string_view text, char separator);

/// Reads exactly `count` whole numbers with a separator between them. Not set for other text.
template <std::size_t count>
[[nodiscard]] std::optional<std::array<int, count>> parse_numbers(std::string_view text,
                                                                  char separator)
{
    const std::optional<std::vector<int>> list = parse_numbers(text, separator);
    if (!list || list->size() != count)
        return std::nullopt;
    std::array<int, count> numbers{};
    std::copy(list->begin(), list->end(), numbers.begin());
    return numbers;
}

/// Reads a number such as 0.004 or a fraction such as 1/255, finite and >= 0. Not set for other
/// text.
[[nodiscard]] std::optional<double> parse_fraction(std::string_view text);

/// Accepts texts for which `accepts` is true. `wanted` describes them in error messages; the help
/// does not show it.
[[nodiscard]] CLI::Validator validator(std::function<bool(const std::string&)> accepts,
                                       std::string wanted);

/// Accepts texts for which `parse` returns a value.
template <class Parse>
[[nodiscard]] CLI::Validator parsed_by(const Parse& parse, std::string wanted)
{
    return validator([parse](const std::string& text) { return parse(text).has_value(); },
                     std::move(wanted));
}

// CLI11's own ranges accept NaN and print their bounds with forty digits.

/// A finite number >= 0.
[[nodiscard]] CLI::Validator non_negative_number();
/// A text for parse_fraction().
[[nodiscard]] CLI::Validator non_negative_fraction();
/// A text for parse_fraction(), other than 0.
[[nodiscard]] CLI::Validator positive_fraction();
/// A finite number > 0.
[[nodiscard]] CLI::Validator positive_number();
/// A number from 0 to 1.
[[nodiscard]] CLI::Validator share();
/// A whole number from `least` to `most`.
[[nodiscard]] CLI::Validator whole_number(int least, int most);
/// The name of a file. Rejects an empty name, such as from an unset shell variable.
[[nodiscard]] CLI::Validator file_name();
/// The name of a file other than -, for options that cannot use standard output.
[[nodiscard]] CLI::Validator own_file_name();
[[nodiscard]] CLI::Validator folder_name();
/// One of a few words, which shells complete.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);
/// One of more words than fit on a line. Messages suggest similar words, and `wanted` says where
/// all of them are listed.
[[nodiscard]] CLI::Validator one_of_many(std::vector<std::string> words, std::string wanted);
/// Accepts any text. Shells complete these words; the reader of the option checks the text.
[[nodiscard]] CLI::Validator offers(const std::vector<std::string>& words);
/// The words of an option with one_of(), one_of_many() or offers(); empty for other options.
[[nodiscard]] std::vector<std::string> offered_words(CLI::Option& option);

}  // namespace packtrace::cli
