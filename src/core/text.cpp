#include "core/text.hpp"

#include <array>
#include <charconv>

namespace packtrace {
namespace {

/// Uses a decimal point in every locale, which the calling program may have set.
std::string printed(double value, std::chars_format format, int digits)
{
    std::array<char, 512> text;
    char* const begin = text.data();
    return {begin, std::to_chars(begin, begin + text.size(), value, format, digits).ptr};
}

}  // namespace

std::string fixed(double value, int decimals)
{
    return printed(value, std::chars_format::fixed, decimals);
}

std::string brief(double value, int digits)
{
    return printed(value, std::chars_format::general, digits);
}

std::string counted(std::int64_t number, std::string_view what)
{
    return counted(number, what, std::string(what) + "s");
}

std::string counted(std::int64_t number, std::string_view one, std::string_view many)
{
    return std::to_string(number) + " " + std::string(number == 1 ? one : many);
}

std::string joined(const std::vector<std::string>& words, std::string_view between)
{
    return joined(words, between, [](const std::string& word) { return word; });
}

std::string replaced(std::string_view text, char letter, std::string_view by)
{
    std::string result;
    for (const char c : text)
        result += c == letter ? by : std::string_view(&c, 1);
    return result;
}

}  // namespace packtrace
