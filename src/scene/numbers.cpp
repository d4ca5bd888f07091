#include "scene/numbers.hpp"

#include "scene/quote.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

namespace packtrace::reader {

double to_number(const Field& field, const Word& word)
{
    std::string_view digits = word.text;
    // from_chars takes a minus sign only.
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-')
        digits.remove_prefix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = end == digits.data() + digits.size();
    if (whole && error == std::errc::result_out_of_range)
        fail(field.source, word.at,
             quote(word.text) + " is beyond double precision; stay within 1e-307 and 1e308");
    if (!whole || error != std::errc{})
        fail(field.source, word.at,
             quote(field.entry.key.text) + " wants a number, not " + quote(word.text) +
                 "; write it like 2, -0.5 or 1e3");
    if (!std::isfinite(number))
        fail(field.source, word.at,
             quote(field.entry.key.text) + " wants a finite number, not " + quote(word.text) +
                 "; write it like 2, -0.5 or 1e3");
    return number;
}

std::string to_text(double number)
{
    char buffer[32];
    // 1000000 rather than 1e+06.
    const bool whole = std::abs(number) < 1e15 && number == std::floor(number);
    const auto format = whole ? std::chars_format::fixed : std::chars_format::general;
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, number, format);
    return error == std::errc{} ? std::string(buffer, end) : std::string("?");
}

}  // namespace packtrace::reader
