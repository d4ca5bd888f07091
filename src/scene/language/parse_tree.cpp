#include "scene/language/grammar.hpp"
#include "scene/language/quote.hpp"
#include "scene/language/syntax_tree.hpp"
#include "scene/language/values.hpp"

#include <tao/pegtl.hpp>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace packtrace::language {
namespace {

// A syntax tree takes far more memory than its text. These limits bound it for text that is not a
// scene: no key takes as many numbers.
constexpr std::size_t most_items = most_points;
constexpr std::size_t most_numbers = 64;

/// Builds the syntax tree while the grammar matches. Calls come in the order of the text.
class TreeBuilder {
public:
    explicit TreeBuilder(const Source& source) : source_(source), open_(1)
    {
        open_[0].kind = EntryKind::block;
    }

    void begin_entry(Word key)
    {
        check_room(entries_++, most_keys, key.at, "keys in a file");
        open_.emplace_back().key = key;
    }

    void open_block(Word brace)
    {
        open_.back().kind = EntryKind::block;
        braces_.push_back(brace.at);
    }

    void name_block(Word name)
    {
        open_.back().name = name;
    }

    void end_entry()
    {
        Entry entry = std::move(open_.back());
        open_.pop_back();
        if (entry.kind == EntryKind::block)
            braces_.pop_back();
        open_.back().entries.push_back(std::move(entry));
    }

    template <ItemKind kind>
    void add_item(Word word)
    {
        std::vector<Item>& value = open_.back().value;
        check_room(value.size(), most_items, word.at, "items in a value");
        value.push_back({kind, word.at, word.text, {}});
    }

    void add_tuple(Word function)
    {
        function.text.remove_suffix(1);
        add_item<ItemKind::tuple>(function);
    }

    void add_size(Word first)
    {
        add_item<ItemKind::size>(first);
        add_part(first);
    }

    /// Adds a part to the last item, which is a tuple or size.
    void add_part(Word part)
    {
        std::vector<Word>& parts = open_.back().value.back().parts;
        check_room(parts.size(), most_numbers, part.at, "numbers in a tuple");
        parts.push_back(part);
    }

    [[nodiscard]] const Source& source() const
    {
        return source_;
    }

    [[nodiscard]] std::string_view current_key() const
    {
        return open_.back().key.text;
    }

    /// The position of the innermost open block's brace.
    [[nodiscard]] Position open_brace() const
    {
        return braces_.back();
    }

    [[nodiscard]] Entry take()
    {
        return std::move(open_.front());
    }

private:
    void check_room(std::size_t count, std::size_t limit, Position at, const char* things) const
    {
        if (count >= limit)
            fail(source_, at,
                 "more than " + std::to_string(limit) + ' ' + things + "; remove some");
    }

    const Source& source_;
    std::vector<Entry> open_;  ///< the file and the entries being read, outermost first
    std::vector<Position> braces_;
    std::size_t entries_ = 0;  ///< in the file so far
};

template <class Input>
Word word_at(const Input& in)
{
    const auto at = in.position();
    return {Position::of(at.line, at.column), std::string_view(in.begin(), in.size())};
}

/// Calls the builder's `step` with the text that a rule matched.
template <auto step>
struct Call {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        (builder.*step)(word_at(in));
    }
};

/// Calls the builder's `step` with text in quotes. Its position is that of the first quote.
template <auto step>
struct CallQuoted {
    template <class Input>
    static void apply(const Input& in, TreeBuilder& builder)
    {
        Word word = word_at(in);
        --word.at.column;
        (builder.*step)(word);
    }
};

template <class Rule>
struct Action : tao::pegtl::nothing<Rule> {
};
template <>
struct Action<grammar::key> : Call<&TreeBuilder::begin_entry> {
};
template <int depth>
struct Action<grammar::entry<depth>> {
    static void apply0(TreeBuilder& builder)
    {
        builder.end_entry();
    }
};
template <>
struct Action<grammar::open_brace> : Call<&TreeBuilder::open_block> {
};
template <>
struct Action<grammar::block_name> : Call<&TreeBuilder::name_block> {
};
template <>
struct Action<grammar::name_text> : CallQuoted<&TreeBuilder::name_block> {
};
template <>
struct Action<grammar::word_value> : Call<&TreeBuilder::add_item<ItemKind::word>> {
};
template <>
struct Action<grammar::quoted_text> : CallQuoted<&TreeBuilder::add_item<ItemKind::text>> {
};
template <>
struct Action<grammar::tuple_open> : Call<&TreeBuilder::add_tuple> {
};
template <>
struct Action<grammar::tuple_part> : Call<&TreeBuilder::add_part> {
};
template <>
struct Action<grammar::size_first> : Call<&TreeBuilder::add_size> {
};
template <>
struct Action<grammar::size_second> : Call<&TreeBuilder::add_part> {
};

/// Makes the message for a rule that must match and does not. `key` is quoted, `found` is the text
/// found instead.
using Complaint = std::string (*)(const std::string& key, const std::string& found);

std::string expected_number(const std::string&, const std::string& found)
{
    return "expected a number, not " + found + "; write tuples as (1, 2, 3)";
}

std::string expected_entry(const std::string&, const std::string& found)
{
    if (found == "'}'")
        return "unexpected '}', no block is open here; remove it";
    return "expected a key, not " + found + "; write key = value or key { ... }";
}

template <class Rule>
constexpr Complaint complaint = [](const std::string& key, const std::string& found) {
    return "expected a value for " + key + ", not " + found +
           "; write a number, a word, (x, y, z) or \"text\"";
};
template <>
constexpr Complaint complaint<grammar::tuple_part> = expected_number;
template <>
constexpr Complaint complaint<grammar::tuple_close> =
    [](const std::string&, const std::string& found) {
        return "expected ',' or ')', not " + found + "; write tuples as (1, 2, 3)";
    };
template <>
constexpr Complaint complaint<grammar::closing_quote> = [](const auto&, const auto&) {
    return std::string("the text has no closing quote; end it with \" on the same line");
};
template <int depth>
constexpr Complaint complaint<grammar::right_side<depth>> =
    [](const std::string& key, const std::string& found) {
        return "expected '=' or '{' after " + key + ", not " + found +
               "; write key = value or key { ... }";
    };
template <>
constexpr Complaint complaint<grammar::too_deep> = [](const auto&, const auto&) {
    return std::string("blocks stand too deep in each other; close an outer one with '}' first");
};
template <>
constexpr Complaint complaint<grammar::close_brace> = expected_entry;
template <>
constexpr Complaint complaint<grammar::end_of_file> = expected_entry;

bool is_word_byte(char c)
{
    // Bytes from 0x80 on are parts of one character.
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '+' ||
           c == '-' || static_cast<unsigned char>(c) >= 0x80u;
}

/// Describes the first word or character of the text.
std::string name_found(std::string_view rest)
{
    if (rest.empty())
        return "the file's end";
    if (rest[0] == '\n' || rest[0] == '\r')
        return "the line's end";
    const auto end = std::find_if_not(rest.begin(), rest.end(), is_word_byte);
    return quote(
        rest.substr(0, std::max<std::size_t>(1, static_cast<std::size_t>(end - rest.begin()))));
}

/// Reports a failed rule with our own message.
template <class Rule>
struct Control : tao::pegtl::normal<Rule> {
    template <class Input>
    [[noreturn]] static void raise(const Input& in, TreeBuilder& builder)
    {
        const std::string key = quote(builder.current_key());
        const std::string_view rest(in.current(), in.size());
        // The error is at the brace without a partner, not at the file's end.
        if (std::is_same_v<Rule, grammar::close_brace> && rest.empty())
            fail(builder.source(), builder.open_brace(),
                 "the block " + key + " has no closing brace; end it with '}'");
        const auto at = in.position();
        fail(builder.source(), Position::of(at.line, at.column),
             complaint<Rule>(key, name_found(rest)));
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

}  // namespace packtrace::language
