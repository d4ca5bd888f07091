#pragma once

#include <tao/pegtl.hpp>

/// The grammar of the scene language. It does not depend on the meaning of keys.
namespace packtrace::language::grammar {

using namespace tao::pegtl;

/// The deepest nesting of blocks: scene, animation, key.
inline constexpr int deepest_block = 3;

struct comment : seq<one<'#'>, star<not_one<'\n'>>> {};
struct gap : star<sor<plus<one<' ', '\t', '\r', '\n'>>, comment>> {};

struct word_char : sor<alnum, one<'_', '.', '+', '-'>> {};
struct word : plus<word_char> {};

// 640 x 480. The blanks may be missing, so the grammar needs numbers to find the x in a word.
struct sign : opt<one<'+', '-'>> {};
struct mantissa : sor<seq<plus<digit>, opt<one<'.'>, star<digit>>>, seq<one<'.'>, plus<digit>>> {};
struct exponent : seq<one<'e', 'E'>, sign, plus<digit>> {};
struct number : seq<sign, mantissa, opt<exponent>> {};
struct size_first : number {};
struct size_second : number {};
struct size_shape : seq<number, gap, one<'x'>, gap, number, not_at<word_char>> {};
struct size_value : seq<at<size_shape>, size_first, gap, one<'x'>, gap, size_second> {};

struct tuple_open : seq<star<sor<alnum, one<'_'>>>, one<'('>> {};
struct tuple_part : word {};
struct tuple_close : one<')'> {};
struct tuple_value : if_must<tuple_open, gap, tuple_part, gap,
                             star<one<','>, gap, must<tuple_part>, gap>, tuple_close> {};

struct quoted_text : star<not_one<'"', '\n'>> {};
struct closing_quote : one<'"'> {};
struct quoted_value : if_must<one<'"'>, quoted_text, closing_quote> {};

// A word before '=' or '{' is the next entry's key, and the value before it is missing.
struct next_entry : seq<gap, one<'=', '{'>> {};
struct word_value : seq<word, not_at<next_entry>> {};

struct item : sor<quoted_value, tuple_value, size_value, word_value> {};
struct value : seq<item, star<gap, one<','>, gap, must<item>>> {};
struct assignment : if_must<one<'='>, gap, value> {};

template <int depth>
struct entry;
struct open_brace : one<'{'> {};
struct close_brace : one<'}'> {};
struct too_deep : failure {};
template <int depth>
struct block : if_must<open_brace, gap, star<entry<depth + 1>>, close_brace> {
};
template <>
struct block<deepest_block> : if_must<at<open_brace>, too_deep> {
};

struct key : word {};
struct block_name : word {};
struct name_text : quoted_text {};
struct quoted_name : seq<one<'"'>, name_text, one<'"'>> {};
struct any_name : sor<block_name, quoted_name> {};
// Looks ahead, so that an error is reported at the word after the key.
template <int depth>
struct named_block : seq<at<any_name, gap, open_brace>, any_name, gap, block<depth>> {
};
template <int depth>
struct right_side : sor<assignment, block<depth>, named_block<depth>> {
};
template <int depth>
struct entry : seq<key, gap, must<right_side<depth>>, gap> {
};

struct end_of_file : eof {};
struct file : seq<opt<utf8::bom>, gap, star<entry<0>>, must<end_of_file>> {};

}  // namespace packtrace::language::grammar
