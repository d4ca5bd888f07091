#include "scene/language/quote.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace packtrace::language {
namespace {

constexpr std::size_t longest_quote = 40;

bool is_continuation(std::string_view text, std::size_t i)
{
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0u) == 0x80u;
}

/// Characters of several bytes that are invisible in a message: control characters, spaces such as
/// the no-break space, marks of byte order and direction.
bool is_invisible(std::string_view letter)
{
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(letter[i]); };
    if (letter.size() == 2)
        return byte(0) == 0xC2u && (byte(1) <= 0xA0u || byte(1) == 0xADu);
    if (letter.size() != 3)
        return false;
    const bool general = byte(0) == 0xE2u && byte(1) == 0x80u &&
                         (byte(2) <= 0x8Fu || (byte(2) >= 0xA8u && byte(2) <= 0xAFu));
    return general || letter == "\xE3\x80\x80" || letter == "\xEF\xBB\xBF";
}

/// The number of bytes of the printable character at the start of `text`; 0 if there is none.
/// Over-long forms and surrogates are accepted, because they do no harm to a terminal.
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
    return is_invisible(text.substr(0, length)) ? 0 : length;
}

std::string hex_escape(char byte)
{
    constexpr char digits[] = "0123456789abcdef";
    const auto value = static_cast<unsigned char>(byte);
    return {'\\', 'x', digits[value >> 4u], digits[value & 15u]};
}

constexpr std::size_t largest_slip = 2;

/// Optimal string alignment distance (Damerau, A Technique for Computer Detection and
/// Correction of Spelling Errors, 1964), row by row.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    std::iota(above.begin(), above.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before.swap(above);
        above.swap(row);
    }
    return above[b.size()];
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
        // Do not cut inside a character.
        while (end > 0 && is_continuation(text, end))
            --end;
    }
    return '\'' + escape(text.substr(0, end)) + (end < text.size() ? "...'" : "'");
}

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known)
{
    std::string_view nearest;
    // A limit below the length, because two edits turn a word of two letters into any other.
    std::size_t limit = std::min(largest_slip + 1, word.size());
    for (const std::string_view candidate : known) {
        if (word.size() > candidate.size() + largest_slip)
            continue;
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < limit) {
            limit = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string_view nearest_word(std::string_view word, const std::vector<std::string>& known)
{
    const std::vector<std::string_view> views(known.begin(), known.end());
    return nearest_word(word, views);
}

std::string suggest(std::string_view word, std::span<const std::string_view> known)
{
    const std::string_view nearest = nearest_word(word, known);
    if (!nearest.empty())
        return "did you mean " + quote(nearest) + "?";
    return "use one of: " + join(known);
}

std::string join(std::span<const std::string_view> words)
{
    return joined(words, ", ", escape);
}

}  // namespace packtrace::language
