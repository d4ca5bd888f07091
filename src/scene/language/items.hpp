#pragma once

#include "scene/language/numbers.hpp"
#include "scene/language/syntax_tree.hpp"
#include <packtrace/vec.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

// Reads numbers and words from the items of a key's value. All functions throw SceneError at the
// position of the error.
namespace packtrace::language {

/// Throws SceneError: the key wants another kind of value. `form` is an example of it.
[[noreturn]] void fail_kind(const Field& field, Position at, std::string_view wanted,
                            std::string_view form);

/// The only item of the value, which must have one of two kinds.
[[nodiscard]] const Item& only_item(const Field& field, ItemKind kind, ItemKind other,
                                    std::string_view wanted, std::string_view form);
[[nodiscard]] const Item& only_item(const Field& field, ItemKind kind, std::string_view wanted,
                                    std::string_view form);

/// The numbers of a tuple or size, which must have exactly `count`.
[[nodiscard]] std::vector<double> part_numbers(const Field& field, const Item& item,
                                               std::size_t count, std::string_view form,
                                               const Range& range);
/// The number of an item that is a word.
[[nodiscard]] double item_number(const Field& field, const Item& item, const Range& range);

/// The numbers of a value that is a tuple of exactly `count`. `form` is an example for messages.
[[nodiscard]] std::vector<double> read_numbers(const Field& field, std::size_t count,
                                               std::string_view form,
                                               const Range& range = any_number);

/// The vector of the first three numbers.
[[nodiscard]] inline Vec3 to_vector(const std::vector<double>& numbers)
{
    return {numbers[0], numbers[1], numbers[2]};
}
/// The number of a value that is one number.
[[nodiscard]] double read_number(const Field& field, const Range& range = any_number);
/// The word of a value that is one of `words`.
[[nodiscard]] std::string_view read_word(const Field& field, const Keys& words);
/// Whether the value is one word, not a tuple.
[[nodiscard]] bool is_word(const Field& field);

}  // namespace packtrace::language
