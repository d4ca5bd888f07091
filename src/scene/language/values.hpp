#pragma once

#include <packtrace/vec.hpp>

#include "scene/language/syntax_tree.hpp"
#include "scene/language/words.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// How large and how small the numbers of a scene may be, so that single precision can work with
// them (docs/scene.md, Ranges; tests/test_validate.cpp looks for NaN at their ends).
namespace packtrace {

/// The largest size of a coordinate, a length or any other number. A ray that grazes a plane finds
/// it some 1e7 times as far away, and single precision holds the square of that.
inline constexpr double largest_number = 1e13;

/// The smallest size of a length.
inline constexpr double smallest_length = 1e-15;

/// Of a factor or an intensity. Products of three are far within single precision.
inline constexpr double largest_factor = 1e9;

/// Of an exponent, and of an index of refraction and its inverse. Refraction leaves the length of a
/// direction off by some roundoffs times the square of that index, and highlights are a power of
/// it.
inline constexpr double largest_exponent = 1e4;
inline constexpr double largest_ior = 10.0;

}  // namespace packtrace

// The kinds of values that keys take.
namespace packtrace::language {

/// What is wrong with a value, in words that name its key; nothing where it is right.
using Fault = std::optional<std::string>;

/// How a value is described, read, written and checked.
template <class Value>
struct Type {
    std::string takes;  ///< for the reference: "number above 0"
    /// Throws SceneError that says what the key wants. It takes what `check` finds no fault with.
    std::function<Value(const Field&)> read;
    std::function<void(std::string& out, const Value&)> write;
    /// The first fault of a value under this key, whoever made it. Allocates for a fault only.
    std::function<Fault(std::string_view key, const Value&)> check;
};

/// The numbers that a key takes; both ends belong to the range unless it is `open`.
struct Range {
    double low = -std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::max();
    double smallest = 0.0;            ///< in size, of numbers other than 0
    double largest = largest_number;  ///< in size
    bool open = false;
    bool whole = false;
    std::string_view noun = "number";
    std::string_view part{};    ///< for messages: "a side of "
    std::string_view unit{};    ///< likewise: " pixels"
    std::string_view except{};  ///< "-1 for no highlight": a number outside that is taken too

    /// Whether the key means anything with the number, however large or small.
    [[nodiscard]] bool contains(double number) const;
    /// Whether single precision can work with it.
    [[nodiscard]] bool can_hold(double number) const;
    /// "above 0", "of 0 or more", "from 0 to 1".
    [[nodiscard]] std::string text() const;
};

inline constexpr Range any_number{};
inline constexpr Range any_length{.low = 0.0, .smallest = smallest_length, .open = true};
inline constexpr Range any_ior{
    .low = 0.0, .smallest = 1.0 / largest_ior, .largest = largest_ior, .open = true};
inline constexpr Range any_exponent{.low = 0.0, .largest = largest_exponent};
inline constexpr Range any_factor{.low = 0.0, .largest = largest_factor};
inline constexpr Range share{.low = 0.0, .high = 1.0};

/// What is wrong with a number under this key.
[[nodiscard]] Fault fault_of(std::string_view key, double number, const Range& range);
/// The first fault of several.
[[nodiscard]] Fault fault_of(std::string_view key, std::span<const double> numbers,
                             const Range& range);
[[nodiscard]] Fault fault_of(std::string_view key, const Vec3& vector, const Range& range);

[[nodiscard]] Type<double> number(const Range& range);
[[nodiscard]] Type<int> whole_number(int low, int high);
/// (x, y, z)
[[nodiscard]] Type<Vec3> point();
/// (x, y, z), (x, y, z), …
[[nodiscard]] Type<std::vector<Vec3>> points();
/// (x, y, z) other than (0, 0, 0), as long as written.
[[nodiscard]] Type<Vec3> direction();
/// The same of any length, made 1 unless it is but for rounding.
[[nodiscard]] Type<Vec3> unit_direction();
/// (a, b)
[[nodiscard]] Type<Vec2> pair(const Range& range);
/// `width x height`
[[nodiscard]] Type<Vec2> size(Range range);
/// Two numbers, the second above the first.
[[nodiscard]] Type<ZRange> z_range();
/// (r, g, b) in 0 to 255 or rgb(r, g, b) in 0 to 1, linear in 0 to 1.
[[nodiscard]] Type<Rgb> color();
/// 0 or more: one number for all channels, (r, g, b), or rgb(r, g, b) in 0 to 1.
[[nodiscard]] Type<Rgb> factor();
/// A word, or text in quotes.
[[nodiscard]] Type<std::string> name();
/// The longest name, bytes, and the most corners of a contour.
inline constexpr std::size_t longest_name = 4096;
inline constexpr std::size_t most_points = 65'536;

/// The nine numbers of a rotation, row by row; nearly one is mended with a warning.
[[nodiscard]] Type<Mat3> rotation();

/// Two colours and the edge of a square.
struct CheckerValue {
    Rgb color{1.0};
    Checker checker;
};
[[nodiscard]] Type<CheckerValue> checker();

/// A tuple of just so many numbers; `form` is an example for messages.
[[nodiscard]] std::vector<double> read_numbers(const Field& field, std::size_t count,
                                               std::string_view form,
                                               const Range& range = any_number);

/// Of the first three numbers.
[[nodiscard]] inline Vec3 to_vector(const std::vector<double>& numbers)
{
    return {numbers[0], numbers[1], numbers[2]};
}
/// A value of one number.
[[nodiscard]] double read_number(const Field& field, const Range& range = any_number);
/// Whether the value is one word, not a tuple.
[[nodiscard]] bool is_word(const Field& field);
/// Throws SceneError at the number unless `range` contains it.
void check_range(const Field& field, Position at, double number, const Range& range);

/// The number in the shortest form that reads back as the same.
void append(std::string& out, double number);
/// (a, b, …)
void append(std::string& out, std::span<const double> numbers);
[[nodiscard]] std::string shortest(double number);
/// The number as text for a message: 1000000 rather than 1e+06.
[[nodiscard]] std::string to_text(double number);

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

/// The one of `words` that the value is. Throws SceneError for another.
[[nodiscard]] std::string_view read_word(const Field& field, const Keys& words);

/// One of an enumeration's words.
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
            [words](const Field& field) {
                const std::string_view word = read_word(field, words);
                for (const Spelling<Enum>& spelling : spellings(Enum{}))
                    if (spelling.word == word)
                        return spelling.value;
                return Enum{};
            },
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
