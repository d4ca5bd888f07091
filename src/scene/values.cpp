#include "scene/values.hpp"

#include <cmath>

#include "scene/nearest_word.hpp"
#include "scene/numbers.hpp"
#include "scene/quote.hpp"

namespace packtrace::reader {
namespace {

[[noreturn]] void fail_kind(const Field& field, Position at, const std::string& wanted,
                            const std::string& form)
{
    const std::string key(field.entry.key.text);
    fail(field.source, at, "'" + key + "' wants " + wanted + "; write " + key + " = " + form);
}

/// The value's only item, of one of two kinds.
const Item& only_item(const Field& field, ItemKind kind, ItemKind other, const std::string& wanted,
                      const std::string& form)
{
    if (field.entry.kind != EntryKind::value)
        fail_kind(field, field.entry.key.at, wanted + ", not a block", form);
    const Item& item = field.entry.value[0];
    if (item.kind != kind && item.kind != other)
        fail_kind(field, item.at, wanted, form);
    if (field.entry.value.size() > 1)
        fail_kind(field, field.entry.value[1].at, "one value, not a list", form);
    return item;
}

const Item& only_item(const Field& field, ItemKind kind, const std::string& wanted,
                      const std::string& form)
{
    return only_item(field, kind, kind, wanted, form);
}

std::vector<double> part_numbers(const Field& field, const Item& item, std::size_t count,
                                 const std::string& form)
{
    if (item.parts.size() != count)
        fail_kind(field, item.at,
                  std::to_string(count) + " numbers, not " + std::to_string(item.parts.size()),
                  form);
    std::vector<double> numbers;
    for (const Word& part : item.parts)
        numbers.push_back(to_number(field, part));
    return numbers;
}

/// A tuple without a function's name before it.
std::vector<double> plain_tuple(const Field& field, std::size_t count, const std::string& form)
{
    const std::string wanted = std::to_string(count) + " numbers in brackets";
    const Item& item = only_item(field, ItemKind::tuple, wanted, form);
    if (!item.text.empty())
        fail_kind(field, item.at, wanted, form);
    return part_numbers(field, item, count, form);
}

void check_range(const Field& field, Position at, double number, Range range)
{
    if (number >= range.low && number <= range.high)
        return;
    const std::string limits = range.high == Range{}.high
                                   ? to_text(range.low) + " or more"
                                   : "from " + to_text(range.low) + " to " + to_text(range.high);
    fail(field.source, at,
         quote(field.entry.key.text) + " is " + to_text(number) + "; use " + limits);
}

Vec3 to_vec3(const std::vector<double>& numbers)
{
    return {numbers[0], numbers[1], numbers[2]};
}

Rgb channels_in(const Field& field, const Item& item, Range range, const std::string& form)
{
    const Rgb rgb = to_vec3(part_numbers(field, item, 3, form));
    for (int channel = 0; channel < 3; ++channel)
        check_range(field, item.parts[static_cast<std::size_t>(channel)].at, rgb[channel], range);
    return rgb;
}

constexpr char color_form[] = "(255, 128, 0) or rgb(1, 0.5, 0)";
constexpr char factor_form[] = "0.5 or (0.5, 0.4, 0.3)";

}  // namespace

double item_number(const Field& field, const Item& item)
{
    if (item.kind != ItemKind::word)
        fail_kind(field, item.at, "a number", "0.5");
    return to_number(field, {item.at, item.text});
}

double read_number(const Field& field)
{
    return item_number(field, only_item(field, ItemKind::word, "a number", "0.5"));
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
    const Item& item = only_item(field, ItemKind::word, "a whole number", std::to_string(low));
    const double number = to_number(field, {item.at, item.text});
    check_range(field, item.at, number, {static_cast<double>(low), static_cast<double>(high)});
    if (number != std::floor(number))
        fail_kind(field, item.at, "a whole number, not " + to_text(number),
                  to_text(std::floor(number)));
    return static_cast<int>(number);
}

bool read_flag(const Field& field)
{
    static constexpr std::string_view choices[] = {"false", "true"};
    return read_choice(field, choices) == 1;
}

Vec3 read_point(const Field& field)
{
    return to_vec3(plain_tuple(field, 3, "(0, 1, 2)"));
}

Vec3 read_direction(const Field& field)
{
    const Vec3 direction = read_point(field);
    if (direction == Vec3(0.0))
        fail(field.source, field.entry.value[0].at,
             quote(field.entry.key.text) +
                 " is (0, 0, 0), which points nowhere; "
                 "use a vector of any other length");
    return direction;
}

Vec2 read_pair(const Field& field)
{
    const std::vector<double> numbers = plain_tuple(field, 2, "(0.5, 0.5)");
    return {numbers[0], numbers[1]};
}

Vec2 read_size(const Field& field)
{
    const Item& item = only_item(field, ItemKind::size, "a width and a height", "4 x 3");
    const std::vector<double> numbers = part_numbers(field, item, 2, "4 x 3");
    for (std::size_t i = 0; i < 2; ++i)
        if (!(numbers[i] > 0.0))
            fail(field.source, item.parts[i].at,
                 quote(field.entry.key.text) + " has a side of " + to_text(numbers[i]) +
                     "; use numbers above 0");
    return {numbers[0], numbers[1]};
}

std::vector<double> read_numbers(const Field& field, std::size_t count)
{
    std::string form = "(0";
    for (std::size_t i = 1; i < count; ++i)
        form += ", 0";
    return plain_tuple(field, count, form + ")");
}

Rgb item_color(const Field& field, const Item& item)
{
    if (item.kind == ItemKind::tuple && item.text == "rgb")
        return channels_in(field, item, {0.0, 1.0}, color_form);
    if (item.kind == ItemKind::tuple && item.text.empty())
        return channels_in(field, item, {0.0, 255.0}, color_form) / 255.0;
    fail_kind(field, item.at, "a colour", color_form);
}

Rgb read_color(const Field& field)
{
    return item_color(field, only_item(field, ItemKind::tuple, "a colour", color_form));
}

Rgb read_factor(const Field& field)
{
    const std::string wanted = "a number or one for each channel";
    const Item& item = only_item(field, ItemKind::word, ItemKind::tuple, wanted, factor_form);
    if (item.kind == ItemKind::word)
        return Rgb(read_not_negative(field));
    if (item.text == "rgb")
        return channels_in(field, item, {0.0, 1.0}, factor_form);
    if (item.text.empty())
        return channels_in(field, item, not_negative, factor_form);
    fail_kind(field, item.at, wanted, factor_form);
}

std::string_view read_name(const Field& field)
{
    return only_item(field, ItemKind::word, ItemKind::text, "a name", "\"the name\"").text;
}

std::size_t read_choice(const Field& field, std::span<const std::string_view> choices)
{
    const std::string form(choices[0]);
    const Item& item = only_item(field, ItemKind::word, "one of " + join(choices), form);
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (choices[i] == item.text)
            return i;
    fail(field.source, item.at,
         "unknown " + std::string(field.entry.key.text) + " " + quote(item.text) + "; " +
             suggest(item.text, choices));
}

}  // namespace packtrace::reader
