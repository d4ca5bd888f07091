#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace packtrace::cli {

// CLI11's own ranges let NaN pass and name their bounds with forty digits.

/// A finite number >= 0.
[[nodiscard]] CLI::Validator non_negative_number();
/// A finite number > 0.
[[nodiscard]] CLI::Validator positive_number();
/// A number from 0 to 1.
[[nodiscard]] CLI::Validator share();
/// A whole number from `least` to `most`.
[[nodiscard]] CLI::Validator whole_number(int least, int most);
/// One of a few words.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

}  // namespace packtrace::cli
