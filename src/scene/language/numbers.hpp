#pragma once

#include <packtrace/vec.hpp>

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

// The ranges of numbers in scenes, so that single precision can represent them and their products
// (docs/scene.md, Ranges; tests/test_validate.cpp searches for NaN at the ends of the ranges).
namespace packtrace {

/// The largest magnitude of a coordinate, a length or any other number. A ray that grazes a plane
/// hits it some 1e7 times as far away, and single precision can represent the square of that
/// distance.
inline constexpr double largest_number = 1e13;

/// The smallest length.
inline constexpr double smallest_length = 1e-15;

/// The largest factor or intensity. A product of three of them is far within single precision.
inline constexpr double largest_factor = 1e9;

/// The largest exponent, and the largest index of refraction and inverse of one. Refraction causes
/// a relative error of some roundoffs times the squared index in the length of a direction, and a
/// highlight is a power of that length.
inline constexpr double largest_exponent = 1e4;
inline constexpr double largest_ior = 10.0;

}  // namespace packtrace

// The numbers that keys take, and their text.
namespace packtrace::language {

/// What is wrong with a value, as a text that names its key; not set for a valid value.
using Fault = std::optional<std::string>;

/// The numbers that a key takes. Both ends belong to the range unless it is `open`.
struct Range {
    double low = -std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::max();
    double smallest = 0.0;            ///< smallest magnitude of numbers other than 0
    double largest = largest_number;  ///< largest magnitude
    bool open = false;
    bool whole = false;
    std::string_view noun = "number";
    std::string_view part{};    ///< for messages: "a side of "
    std::string_view unit{};    ///< for messages: " pixels"
    std::string_view except{};  ///< "-1 for no highlight": a number outside the range, also valid

    /// Whether the number has a meaning for the key. Its magnitude is not checked.
    [[nodiscard]] bool contains(double number) const;
    /// Whether the magnitude is suitable for single precision.
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

/// The fault of a number for this key.
[[nodiscard]] Fault fault_of(std::string_view key, double number, const Range& range);
/// The first fault of several numbers.
[[nodiscard]] Fault fault_of(std::string_view key, std::span<const double> numbers,
                             const Range& range);
[[nodiscard]] Fault fault_of(std::string_view key, const Vec3& vector, const Range& range);

/// The syntax of numbers, for messages.
inline constexpr const char* number_form = "write it like 2, -0.5 or 1e3";

/// Appends the number in the shortest form that reads back as the same number.
void append(std::string& out, double number);
/// (a, b, …)
void append(std::string& out, std::span<const double> numbers);
[[nodiscard]] std::string shortest(double number);
/// The number as text for a message: 1000000 rather than 1e+06.
[[nodiscard]] std::string to_text(double number);

}  // namespace packtrace::language
