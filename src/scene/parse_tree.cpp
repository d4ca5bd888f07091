#include "scene/grammar.hpp"
#include "scene/syntax_error.hpp"
#include "scene/syntax_tree.hpp"
#include "scene/tree_builder.hpp"

#include <tao/pegtl.hpp>

#include <string_view>

namespace packtrace::reader {
namespace {

template <class Input>
Word word_at(const Input& in)
{
    const auto at = in.position();
    return {Position::of(at.line, at.column), std::string_view(in.begin(), in.size())};
}

// What the builder is told when a rule has matched.
template <class Rule>
struct Action : tao::pegtl::nothing<Rule> {
};

template <>
struct Action<grammar::key> {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        builder.begin_entry(word_at(in));
    }
};

template <int depth>
struct Action<grammar::entry<depth>> {
    static void apply0(TreeBuilder& builder)
    {
        builder.end_entry();
    }
};

template <>
struct Action<grammar::open_brace> {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        builder.open_block(word_at(in).at);
    }
};

/// The text between quotes, at the place of the first.
template <class Input>
Word quoted_at(const Input& in)
{
    Word word = word_at(in);
    --word.at.column;
    return word;
}

template <>
struct Action<grammar::block_name> {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        builder.name_block(word_at(in));
    }
};
template <>
struct Action<grammar::name_text> {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        builder.name_block(quoted_at(in));
    }
};

template <>
struct Action<grammar::word_value> {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        builder.add_item(ItemKind::word, word_at(in));
    }
};
template <>
struct Action<grammar::quoted_text> {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        builder.add_item(ItemKind::text, quoted_at(in));
    }
};

template <>
struct Action<grammar::tuple_open> {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        Word function = word_at(in);
        function.text.remove_suffix(1);
        builder.add_item(ItemKind::tuple, function);
    }
};

struct AddPart {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        builder.add_part(word_at(in));
    }
};
template <>
struct Action<grammar::tuple_part> : AddPart {
};
template <>
struct Action<grammar::size_second> : AddPart {
};
template <>
struct Action<grammar::size_first> {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        builder.add_item(ItemKind::size, word_at(in));
        builder.add_part(word_at(in));
    }
};

// Turns the failure of a rule that must match into our own message.
template <class Rule>
struct Control : tao::pegtl::normal<Rule> {
    template <class Input>
    [[noreturn]] static void raise(const Input& in, TreeBuilder& builder)
    {
        const auto at = in.position();
        fail_syntax(SyntaxRule<Rule>::value, builder, Position::of(at.line, at.column),
                    std::string_view(in.current(), in.size()));
    }
};

}  // namespace

Entry parse_tree(const Source& source)
{
    tao::pegtl::memory_input<> input(source.text.data(), source.text.size(), "");
    TreeBuilder builder(source);
    tao::pegtl::parse<grammar::file, Action, Control>(input, builder);
    return builder.take();
}

}  // namespace packtrace::reader
