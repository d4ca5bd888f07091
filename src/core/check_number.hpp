#pragma once

#include "core/text.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

// Options of the library's callers: each fault is one line that says what there is instead.
namespace packtrace {

/// Threads that work together at most.
inline constexpr int most_threads = 1024;
/// Repetitions of a measurement at most.
inline constexpr int most_repetitions = 1000;

/// Throws std::invalid_argument for a number outside `least` … `most`.
inline void check_number(const std::string& option, int number, int least, int most)
{
    if (number < least || number > most)
        throw std::invalid_argument(option + ": " + std::to_string(number) + "; choose from " +
                                    std::to_string(least) + " to " + std::to_string(most));
}

/// The same for what is not a finite number from 0 on.
inline void check_not_negative(const std::string& option, double number)
{
    if (!(number >= 0.0) || !std::isfinite(number))
        throw std::invalid_argument(option + ": " + brief(number, 6) +
                                    "; choose a finite number >= 0");
}

}  // namespace packtrace
