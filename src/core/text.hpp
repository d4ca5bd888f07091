#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

// Small steps of making texts, and numbers of them.
namespace packtrace {

/// A number with a fixed count of decimals.
[[nodiscard]] std::string fixed(double value, int decimals);

/// A number with so many digits, and an exponent where it needs one.
[[nodiscard]] std::string brief(double value, int digits = 3);

/// The number that all of `text` is; nothing where it is none, or out of range.
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

/// What `text` makes of each item, with `between` between each two.
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

/// `text` with `by` in place of each `letter`.
[[nodiscard]] std::string replaced(std::string_view text, char letter, std::string_view by);

}  // namespace packtrace
