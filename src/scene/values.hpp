#pragma once

#include <packtrace/vec.hpp>

#include "scene/block.hpp"
#include "scene/item_checks.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

// Each takes a field's value as one kind of thing, or throws SceneError that says what the key
// wants. Numbers are finite throughout.
namespace packtrace::reader {

[[nodiscard]] double read_number(const Field& field);
[[nodiscard]] double read_number_in(const Field& field, Range range);
/// Above 0.
[[nodiscard]] double read_positive(const Field& field);
[[nodiscard]] double read_not_negative(const Field& field);
/// A whole number, both ends included.
[[nodiscard]] int read_integer(const Field& field, int low, int high);

/// (x, y, z)
[[nodiscard]] Vec3 read_point(const Field& field);
/// (x, y, z) other than (0, 0, 0), as long as written.
[[nodiscard]] Vec3 read_direction(const Field& field);
/// (a, b)
[[nodiscard]] Vec2 read_pair(const Field& field);
/// `width x height`, both above 0.
[[nodiscard]] Vec2 read_size(const Field& field);
/// A tuple of just so many numbers; `form` is an example for messages.
[[nodiscard]] std::vector<double> read_numbers(const Field& field, std::size_t count,
                                               std::string_view form);

/// (r, g, b) in 0 to 255 or rgb(r, g, b) in 0 to 1, linear in 0 to 1.
[[nodiscard]] Rgb read_color(const Field& field);
/// A factor, 0 or more: one number for all channels, (r, g, b), or rgb(r, g, b) in 0 to 1.
[[nodiscard]] Rgb read_factor(const Field& field);

/// A word, or text in quotes.
[[nodiscard]] std::string_view read_name(const Field& field);
/// The index in `choices` of the word that the value is.
[[nodiscard]] std::size_t read_choice(const Field& field,
                                      std::span<const std::string_view> choices);
/// true or false
[[nodiscard]] bool read_flag(const Field& field);

// The same of one item of a longer value, which `form` shows in messages.
[[nodiscard]] double item_number(const Field& field, const Item& item, std::string_view form);
[[nodiscard]] Rgb item_color(const Field& field, const Item& item, std::string_view form);

}  // namespace packtrace::reader
