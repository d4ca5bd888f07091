#pragma once

#include "scene/block.hpp"
#include "scene/syntax_tree.hpp"

#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

// What the readers of values share. `wanted` says what a key wants, `form` shows it in an example.
namespace packtrace::reader {

/// Both ends belong to the range.
struct Range {
    double low = -std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::max();
};

/// 0 or more.
inline constexpr Range not_negative{0.0, std::numeric_limits<double>::max()};

/// Throws SceneError: the key wants another kind of value.
[[noreturn]] void fail_kind(const Field& field, Position at, std::string_view wanted,
                            std::string_view form);

/// The value's only item, which is of this kind (or, in the second form, of one of two).
[[nodiscard]] const Item& only_item(const Field& field, ItemKind kind, std::string_view wanted,
                                    std::string_view form);
[[nodiscard]] const Item& only_item(const Field& field, ItemKind kind, ItemKind other,
                                    std::string_view wanted, std::string_view form);

/// The finite numbers of a tuple or size that has just so many.
[[nodiscard]] std::vector<double> part_numbers(const Field& field, const Item& item,
                                               std::size_t count, std::string_view form);

/// Throws SceneError at `at` unless `number` lies in `range`.
void check_range(const Field& field, Position at, double number, Range range);

}  // namespace packtrace::reader
