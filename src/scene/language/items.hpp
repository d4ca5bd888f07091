#pragma once

#include "scene/language/numbers.hpp"
#include "scene/language/syntax_tree.hpp"
#include <packtrace/vec.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

// What the items of a key's value say: numbers and words. All throw SceneError at what is wrong.
namespace packtrace::language {

/// The key wants another kind of value; `form` shows one.
[[noreturn]] void fail_kind(const Field& field, Position at, std::string_view wanted,
                            std::string_view form);

/// The value's only item, which is of one of two kinds.
[[nodiscard]] const Item& only_item(const Field& field, ItemKind kind, ItemKind other,
                                    std::string_view wanted, std::string_view form);
[[nodiscard]] const Item& only_item(const Field& field, ItemKind kind, std::string_view wanted,
                                    std::string_view form);

/// The numbers of a tuple or size that has just so many.
[[nodiscard]] std::vector<double> part_numbers(const Field& field, const Item& item,
                                               std::size_t count, std::string_view form,
                                               const Range& range);
/// The number that a word is.
[[nodiscard]] double item_number(const Field& field, const Item& item, const Range& range);

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
/// The one of `words` that the value is.
[[nodiscard]] std::string_view read_word(const Field& field, const Keys& words);
/// Whether the value is one word, not a tuple.
[[nodiscard]] bool is_word(const Field& field);

}  // namespace packtrace::language
