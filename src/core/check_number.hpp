#pragma once

#include "core/text.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

// Checks of the options of the library's callers. Each message is one line, and says which values
// are valid.
namespace packtrace {

/// The largest number of threads.
inline constexpr int most_threads = 1024;
/// The largest number of repetitions of a measurement.
inline constexpr int most_repetitions = 1000;

/// Throws std::invalid_argument for a number outside `least` … `most`.
inline void check_number(const std::string& option, int number, int least, int most)
{
    if (number < least || number > most)
        throw std::invalid_argument(option + ": " + std::to_string(number) + "; choose from " +
                                    std::to_string(least) + " to " + std::to_string(most));
}

/// Throws std::invalid_argument unless the number is finite and not negative.
inline void check_not_negative(const std::string& option, double number)
{
    if (!(number >= 0.0) || !std::isfinite(number))
        throw std::invalid_argument(option + ": " + brief(number, 6) +
                                    "; choose a finite number >= 0");
}

}  // namespace packtrace
