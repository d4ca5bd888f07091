#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

// Small functions to make texts, and to read numbers from texts.
namespace packtrace {

/// The number with a fixed number of decimals.
[[nodiscard]] std::string fixed(double value, int decimals);

/// The number with at most `digits` significant digits, and an exponent if it needs one.
[[nodiscard]] std::string brief(double value, int digits = 3);

/// Reads all of `text` as a number. Not set if it is not a number, or out of range.
template <class Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view text)
{
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

/// "1 frame", "2 frames".
[[nodiscard]] std::string counted(std::int64_t number, std::string_view what);
/// "1 vertex", "2 vertices".
[[nodiscard]] std::string counted(std::int64_t number, std::string_view one, std::string_view many);

/// Joins `text(item)` of all items, with `between` as the separator.
template <class Items, class Text>
[[nodiscard]] std::string joined(const Items& items, std::string_view between, const Text& text)
{
    std::string all;
    bool first = true;
    for (const auto& item : items) {
        if (!first)
            all += between;
        first = false;
        all += text(item);
    }
    return all;
}

[[nodiscard]] std::string joined(const std::vector<std::string>& words,
                                 std::string_view between = ", ");

/// Replaces each `letter` in `text` by `by`.
[[nodiscard]] std::string replaced(std::string_view text, char letter, std::string_view by);

}  // namespace packtrace
