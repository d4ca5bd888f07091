#include "scene/item_checks.hpp"

#include "scene/numbers.hpp"
#include "scene/quote.hpp"

#include <string>

namespace packtrace::reader {

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
                                 std::string_view form)
{
    if (item.parts.size() != count)
        fail_kind(field, item.at,
                  std::to_string(count) + " numbers, not " + std::to_string(item.parts.size()),
                  form);
    std::vector<double> numbers;
    numbers.reserve(count);
    for (const Word& part : item.parts)
        numbers.push_back(to_number(field, part));
    return numbers;
}

void check_range(const Field& field, Position at, double number, Range range)
{
    if (number >= range.low && number <= range.high)
        return;
    const std::string limits = range.high == Range{}.high
                                   ? "of " + to_text(range.low) + " or more"
                                   : "from " + to_text(range.low) + " to " + to_text(range.high);
    fail(field.source, at,
         quote(field.entry.key.text) + " is " + to_text(number) + "; use a number " + limits);
}

}  // namespace packtrace::reader
