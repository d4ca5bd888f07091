#pragma once

#include <packtrace/vec.hpp>

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

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

// The numbers that keys take, and how they are written.
namespace packtrace::language {

/// What is wrong with a value, in words that name its key; nothing where it is right.
using Fault = std::optional<std::string>;

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

/// How numbers are written, for messages.
inline constexpr const char* number_form = "write it like 2, -0.5 or 1e3";

/// The number in the shortest form that reads back as the same.
void append(std::string& out, double number);
/// (a, b, …)
void append(std::string& out, std::span<const double> numbers);
[[nodiscard]] std::string shortest(double number);
/// The number as text for a message: 1000000 rather than 1e+06.
[[nodiscard]] std::string to_text(double number);

}  // namespace packtrace::language
