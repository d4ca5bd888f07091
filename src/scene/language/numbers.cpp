#include "scene/language/numbers.hpp"

#include "scene/language/quote.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace packtrace::language {

bool Range::contains(double number) const
{
    if (whole && number != std::floor(number))
        return false;
    const bool inside = open ? number > low && number < high : number >= low && number <= high;
    return inside || (!except.empty() && except.starts_with(to_text(number) + ' '));
}

std::string Range::text() const
{
    const double greatest = std::numeric_limits<double>::max();
    std::string text;
    if (high == greatest)
        text = low == -greatest ? ""
               : open           ? "above " + to_text(low)
                                : "of " + to_text(low) + " or more";
    else
        text = (open ? "above " : "from ") + to_text(low) + (open ? " and below " : " to ") +
               to_text(high);
    return except.empty() ? text : text + ", or " + std::string(except);
}

bool Range::can_hold(double number) const
{
    const double size = std::abs(number);
    return size <= largest && (size >= smallest || size == 0.0);
}

Fault fault_of(std::string_view key, double number, const Range& range)
{
    if (range.contains(number) && range.can_hold(number))
        return std::nullopt;
    if (!std::isfinite(number))
        return quote(key) + " wants a finite number, not " + quote(to_text(number)) + "; " +
               number_form;
    const std::string is = quote(key) + (range.part.empty() ? " is " : " has ") +
                           std::string(range.part) + to_text(number) + std::string(range.unit);
    if (range.contains(number)) {
        const bool large = std::abs(number) > range.largest;
        return is + ", too " + (large ? "large" : "small") + " for single precision; use at " +
               (large ? "most " + shortest(range.largest) : "least " + shortest(range.smallest)) +
               " in size";
    }
    const bool vowel = std::string_view("aeiou").find(range.noun[0]) != std::string_view::npos;
    return is + "; use " +
           (range.whole ? "a whole "
            : vowel     ? "an "
                        : "a ") +
           std::string(range.noun) + ' ' + range.text();
}

Fault fault_of(std::string_view key, std::span<const double> numbers, const Range& range)
{
    for (const double number : numbers)
        if (!range.contains(number) || !range.can_hold(number))
            return fault_of(key, number, range);
    return std::nullopt;
}

Fault fault_of(std::string_view key, const Vec3& vector, const Range& range)
{
    return fault_of(key, std::span<const double>(&vector.x, 3), range);
}

void append(std::string& out, double number)
{
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, number);
    out.append(buffer, end);
}

void append(std::string& out, std::span<const double> numbers)
{
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        out += i == 0 ? '(' : ',';
        append(out, numbers[i]);
    }
    out += ')';
}

std::string shortest(double number)
{
    std::string text;
    append(text, number);
    return text;
}

std::string to_text(double number)
{
    char buffer[32];
    const bool whole = std::abs(number) < 1e15 && number == std::floor(number);
    const auto format = whole ? std::chars_format::fixed : std::chars_format::general;
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, number, format);
    return error == std::errc{} ? std::string(buffer, end) : std::string("?");
}

}  // namespace packtrace::language
