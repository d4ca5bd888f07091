#include "core/text.hpp"

#include <cstdio>

namespace packtrace {
namespace {

std::string printed(const char* format, int digits, double value)
{
    char text[64];
    std::snprintf(text, sizeof text, format, digits, value);
    return text;
}

}  // namespace

std::string fixed(double value, int decimals)
{
    return printed("%.*f", decimals, value);
}

std::string brief(double value, int digits)
{
    return printed("%.*g", digits, value);
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
