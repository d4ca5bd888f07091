#include "scene/quote.hpp"

#include <cstddef>

namespace packtrace::reader {
namespace {

constexpr std::size_t longest_quote = 40;

bool is_continuation(std::string_view text, std::size_t i)
{
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0u) == 0x80u;
}

/// Bytes of the printable character that `text` starts with, 0 when it starts with none.
/// Over-long forms and surrogates pass: they are no danger to a terminal.
std::size_t printable_length(std::string_view text)
{
    const auto first = static_cast<unsigned char>(text[0]);
    if (first < 0x80u)
        return first >= 0x20u && first != 0x7Fu ? 1 : 0;
    const std::size_t length = first >= 0xF0u ? 4 : first >= 0xE0u ? 3 : 2;
    if (first < 0xC2u || first > 0xF4u)
        return 0;
    for (std::size_t i = 1; i < length; ++i)
        if (!is_continuation(text, i))
            return 0;
    // U+0080 to U+009F are control characters too.
    const bool control = first == 0xC2u && static_cast<unsigned char>(text[1]) < 0xA0u;
    return control ? 0 : length;
}

std::string hex_escape(char byte)
{
    constexpr char digits[] = "0123456789abcdef";
    const auto value = static_cast<unsigned char>(byte);
    return {'\\', 'x', digits[value >> 4u], digits[value & 15u]};
}

}  // namespace

std::string escape(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        const std::size_t length = printable_length(text);
        if (length == 0)
            result += hex_escape(text[0]);
        else
            result += text.substr(0, length);
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return result;
}

std::string quote(std::string_view text)
{
    std::size_t end = text.size();
    if (end > longest_quote) {
        end = longest_quote;
        // Not in the middle of a character.
        while (end > 0 && is_continuation(text, end))
            --end;
    }
    return '\'' + escape(text.substr(0, end)) + (end < text.size() ? "...'" : "'");
}

}  // namespace packtrace::reader
