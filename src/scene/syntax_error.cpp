#include "scene/syntax_error.hpp"

#include "scene/quote.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>

namespace packtrace::reader {
namespace {

bool is_word_byte(char c)
{
    // Bytes from 0x80 on belong to one character with their neighbours.
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '+' ||
           c == '-' || static_cast<unsigned char>(c) >= 0x80u;
}

/// The first word or character of what was found instead.
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

std::string describe_entry(std::string_view rest)
{
    if (rest[0] == '}')
        return "unexpected '}', no block is open here; remove it";
    return "expected a key, not " + name_found(rest) + "; write key = value or key { ... }";
}

std::string describe(Expected expected, const std::string& key, std::string_view rest)
{
    switch (expected) {
        case Expected::value:
            return "expected a value for " + key + ", not " + name_found(rest) +
                   "; write a number, a word, (x, y, z) or \"text\"";
        case Expected::part:
            return "expected a number, not " + name_found(rest) + "; write tuples as (1, 2, 3)";
        case Expected::tuple_end:
            return "expected ',' or ')', not " + name_found(rest) + "; write tuples as (1, 2, 3)";
        case Expected::quote_end:
            return "the text has no closing quote; end it with \" on the same line";
        case Expected::right_side:
            return "expected '=' or '{' after " + key + ", not " + name_found(rest) +
                   "; write key = value or key { ... }";
        case Expected::shallower:
            return "blocks stand too deep in each other; close an outer one with '}' first";
        case Expected::block_end:
        case Expected::entry:
            break;
    }
    return describe_entry(rest);
}

}  // namespace

void fail_syntax(Expected expected, const TreeBuilder& builder, Position at, std::string_view rest)
{
    const std::string key = quote(builder.current_key());
    // The place to mend is the brace without a partner, not the file's end.
    if (expected == Expected::block_end && rest.empty())
        fail(builder.source(), builder.open_brace(),
             "the block " + key + " has no closing brace; end it with '}'");
    fail(builder.source(), at, describe(expected, key, rest));
}

}  // namespace packtrace::reader
