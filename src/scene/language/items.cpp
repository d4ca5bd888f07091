#include "scene/language/items.hpp"

#include "scene/language/quote.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace packtrace::language {
namespace {

/// Reads `word` as a number of the range, independently of the locale.
double number_in(const Field& field, const Word& word, const Range& range)
{
    std::string_view digits = word.text;
    // from_chars does not accept a plus sign.
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-')
        digits.remove_prefix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = end == digits.data() + digits.size();
    if (whole && error == std::errc::result_out_of_range)
        fail(field.source, word.at,
             quote(word.text) + " is beyond double precision; stay within 1e-307 and 1e308");
    const bool is_number = whole && error == std::errc{};
    const std::string key = quote(field.entry.key.text);
    if (!is_number)
        fail(field.source, word.at,
             key + " wants a number, not " + quote(word.text) + "; " + number_form);
    if (!std::isfinite(number))
        field.refuse(word.at,
                     key + " wants a finite number, not " + quote(word.text) + "; " + number_form);
    if (const Fault fault = fault_of(field.entry.key.text, number, range))
        field.refuse(word.at, *fault);
    return number;
}

}  // namespace

void fail_kind(const Field& field, Position at, std::string_view wanted, std::string_view form)
{
    const std::string key(field.entry.key.text);
    fail(field.source, at,
         "'" + key + "' wants " + std::string(wanted) + "; write " + key + " = " +
             std::string(form));
}

const Item& only_item(const Field& field, ItemKind kind, ItemKind other, std::string_view wanted,
                      std::string_view form)
{
    if (field.entry.kind != EntryKind::value)
        fail_kind(field, field.entry.key.at, std::string(wanted) + ", not a block", form);
    const Item& item = field.entry.value[0];
    if (item.kind != kind && item.kind != other)
        fail_kind(field, item.at, wanted, form);
    if (field.entry.value.size() > 1)
        fail_kind(field, field.entry.value[1].at, "one value, not a list", form);
    return item;
}

const Item& only_item(const Field& field, ItemKind kind, std::string_view wanted,
                      std::string_view form)
{
    return only_item(field, kind, kind, wanted, form);
}

std::vector<double> part_numbers(const Field& field, const Item& item, std::size_t count,
                                 std::string_view form, const Range& range)
{
    if (item.parts.size() != count)
        fail_kind(field, item.at,
                  std::to_string(count) + " numbers, not " + std::to_string(item.parts.size()),
                  form);
    std::vector<double> numbers;
    numbers.reserve(count);
    for (const Word& part : item.parts)
        numbers.push_back(number_in(field, part, range));
    return numbers;
}

double item_number(const Field& field, const Item& item, const Range& range)
{
    return number_in(field, {item.at, item.text}, range);
}

bool is_word(const Field& field)
{
    return field.entry.kind == EntryKind::value && field.entry.value[0].kind == ItemKind::word;
}

double read_number(const Field& field, const Range& range)
{
    const Item& item = only_item(field, ItemKind::word, range.whole ? "a whole number" : "a number",
                                 range.whole ? to_text(range.high) : "0.5");
    return item_number(field, item, range);
}

std::vector<double> read_numbers(const Field& field, std::size_t count, std::string_view form,
                                 const Range& range)
{
    const Item& item = only_item(field, ItemKind::tuple, "numbers in brackets", form);
    if (!item.text.empty())
        fail_kind(field, item.at, "numbers in brackets only", form);
    return part_numbers(field, item, count, form, range);
}

std::string_view read_word(const Field& field, const Keys& words)
{
    const Item& item = only_item(field, ItemKind::word, "one word", words[0]);
    for (const std::string_view word : words)
        if (word == item.text)
            return word;
    fail(field.source, item.at,
         "unknown " + std::string(field.entry.key.text) + " " + quote(item.text) + "; " +
             suggest(item.text, words));
}

}  // namespace packtrace::language
