#pragma once

#include "scene/grammar.hpp"
#include "scene/source.hpp"
#include "scene/tree_builder.hpp"

#include <string_view>

namespace packtrace::reader {

/// What the grammar wanted where it found something else.
enum class Expected { value, part, tuple_end, quote_end, right_side, block_end, shallower, entry };

template <class Rule>
struct SyntaxRule {
    static constexpr Expected value = Expected::value;
};
template <>
struct SyntaxRule<grammar::tuple_part> {
    static constexpr Expected value = Expected::part;
};
template <>
struct SyntaxRule<grammar::tuple_close> {
    static constexpr Expected value = Expected::tuple_end;
};
template <>
struct SyntaxRule<grammar::closing_quote> {
    static constexpr Expected value = Expected::quote_end;
};
template <int depth>
struct SyntaxRule<grammar::right_side<depth>> {
    static constexpr Expected value = Expected::right_side;
};
template <>
struct SyntaxRule<grammar::close_brace> {
    static constexpr Expected value = Expected::block_end;
};
template <>
struct SyntaxRule<grammar::too_deep> {
    static constexpr Expected value = Expected::shallower;
};
template <>
struct SyntaxRule<grammar::end_of_file> {
    static constexpr Expected value = Expected::entry;
};

/// Throws SceneError for `rest`, the text from `at` on, which starts with something else than
/// expected.
[[noreturn]] void fail_syntax(Expected expected, const TreeBuilder& builder, Position at,
                              std::string_view rest);

}  // namespace packtrace::reader
