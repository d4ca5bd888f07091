#include "scene/numbers.hpp"
#include "scene/quote.hpp"
#include "scene/values.hpp"

#include <cmath>
#include <string>

namespace packtrace::reader {

double item_number(const Field& field, const Item& item, std::string_view form)
{
    if (item.kind != ItemKind::word)
        fail_kind(field, item.at, "a number", form);
    return to_number(field, {item.at, item.text});
}

double read_number(const Field& field)
{
    const Item& item = only_item(field, ItemKind::word, "a number", "0.5");
    return to_number(field, {item.at, item.text});
}

double read_number_in(const Field& field, Range range)
{
    const double number = read_number(field);
    check_range(field, field.entry.value[0].at, number, range);
    return number;
}

double read_positive(const Field& field)
{
    const double number = read_number(field);
    if (!(number > 0.0))
        fail(field.source, field.entry.value[0].at,
             quote(field.entry.key.text) + " is " + to_text(number) + "; use a number above 0");
    return number;
}

double read_not_negative(const Field& field)
{
    return read_number_in(field, not_negative);
}

int read_integer(const Field& field, int low, int high)
{
    const std::string form = std::to_string(high);
    const Item& item = only_item(field, ItemKind::word, "a whole number", form);
    const double number = to_number(field, {item.at, item.text});
    check_range(field, item.at, number, {static_cast<double>(low), static_cast<double>(high)});
    if (number != std::floor(number))
        fail_kind(field, item.at, "a whole number, not " + to_text(number),
                  to_text(std::floor(number)));
    return static_cast<int>(number);
}

}  // namespace packtrace::reader
