#pragma once

#include "scene/language/items.hpp"
#include "scene/language/numbers.hpp"
#include "scene/language/words.hpp"
#include <packtrace/vec.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The types of values that keys take.
namespace packtrace::language {

/// Describes, reads, writes and checks values of one type.
template <class Value>
struct Type {
    std::string takes;  ///< for docs/scene.md: "number above 0"
    /// Throws SceneError with a message that says what the key wants. Accepts exactly the values in
    /// which `check` finds no fault.
    std::function<Value(const Field&)> read;
    std::function<void(std::string& out, const Value&)> write;
    /// The first fault of a value for this key, also of values from code. Allocates only for a
    /// fault.
    std::function<Fault(std::string_view key, const Value&)> check;
};

[[nodiscard]] Type<double> number(const Range& range);
[[nodiscard]] Type<int> whole_number(int low, int high);
/// (x, y, z)
[[nodiscard]] Type<Vec3> point();
/// (x, y, z), (x, y, z), …
[[nodiscard]] Type<std::vector<Vec3>> points();
/// (x, y, z) other than (0, 0, 0). Keeps its length.
[[nodiscard]] Type<Vec3> direction();
/// (x, y, z) other than (0, 0, 0). It is normalised, unless it is_unit() already.
[[nodiscard]] Type<Vec3> unit_direction();
/// (a, b)
[[nodiscard]] Type<Vec2> pair(const Range& range);
/// `width x height`
[[nodiscard]] Type<Vec2> size(Range range);
/// Two numbers, the second above the first.
[[nodiscard]] Type<ZRange> z_range();
/// (r, g, b) in 0 to 255 or rgb(r, g, b) in 0 to 1. The value is linear, in 0 to 1.
[[nodiscard]] Type<Rgb> color();
/// 0 or more: one number for all channels, (r, g, b), or rgb(r, g, b) in 0 to 1.
[[nodiscard]] Type<Rgb> factor();
/// A word, or text in quotes.
[[nodiscard]] Type<std::string> name();
/// The longest name in bytes, and the largest number of corners of a contour.
inline constexpr std::size_t longest_name = 4096;
inline constexpr std::size_t most_points = 65'536;

/// The nine numbers of a rotation, row by row. A matrix that is nearly a rotation is replaced by
/// the nearest one, with a warning.
[[nodiscard]] Type<Mat3> rotation();

/// The two colours of a checker and the edge of its squares.
struct CheckerValue {
    Rgb color{1.0};
    Checker checker;
};
[[nodiscard]] Type<CheckerValue> checker();

template <std::size_t count>
[[nodiscard]] Type<std::array<double, count>> numbers(std::string takes, std::string_view form,
                                                      const Range& range = any_number)
{
    return {
        std::move(takes),
        [=](const Field& field) {
            const std::vector<double> read = read_numbers(field, count, form, range);
            std::array<double, count> result{};
            std::copy(read.begin(), read.end(), result.begin());
            return result;
        },
        [](std::string& out, const auto& value) { append(out, std::span<const double>(value)); },
        [=](std::string_view key, const auto& value) {
            return fault_of(key, std::span<const double>(value), range);
        }};
}

/// One of the words of an enumeration.
template <class Enum>
[[nodiscard]] Type<Enum> choice()
{
    Keys words;
    std::string takes;
    for (const Spelling<Enum>& spelling : spellings(Enum{})) {
        words.push_back(spelling.word);
        if (word_of(spelling.value) != spelling.word)
            continue;
        takes += (takes.empty() ? "`" : ", `") + std::string(spelling.word) + '`';
    }
    return {takes,
            [words](const Field& field) { return *find_word<Enum>(read_word(field, words)); },
            [](std::string& out, Enum value) { out += word_of(value); },
            [](std::string_view key, Enum value) {
                return word_of(value).empty()
                           ? Fault("'" + std::string(key) + "' is number " +
                                   std::to_string(static_cast<int>(value)) +
                                   " of its enumeration, which has no such value; use one it has")
                           : std::nullopt;
            }};
}

}  // namespace packtrace::language
