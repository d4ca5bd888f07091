#include "scene/values.hpp"

#include "scene/quote.hpp"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

namespace packtrace::language {
namespace {

constexpr std::string_view color_form = "(255, 128, 0) or rgb(1, 0.5, 0)";
constexpr std::string_view factor_form = "0.5 or (0.5, 0.4, 0.3)";
constexpr Range byte_range{.low = 0.0, .high = 255.0};

/// Throws SceneError: the key wants another kind of value; `form` shows one.
[[noreturn]] void fail_kind(const Field& field, Position at, std::string_view wanted,
                            std::string_view form)
{
    const std::string key(field.entry.key.text);
    fail(field.source, at,
         "'" + key + "' wants " + std::string(wanted) + "; write " + key + " = " +
             std::string(form));
}

/// The value's only item, which is of one of two kinds.
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

/// The finite number that `word` spells, the same in every locale.
double to_number(const Field& field, const Word& word)
{
    std::string_view digits = word.text;
    // from_chars takes a minus sign only.
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-')
        digits.remove_prefix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = end == digits.data() + digits.size();
    if (whole && error == std::errc::result_out_of_range)
        fail(field.source, word.at,
             quote(word.text) + " is beyond double precision; stay within 1e-307 and 1e308");
    const bool is_number = whole && error == std::errc{};
    if (!is_number || !std::isfinite(number))
        fail(field.source, word.at,
             quote(field.entry.key.text) + " wants a " + (is_number ? "finite " : "") +
                 "number, not " + quote(word.text) + "; write it like 2, -0.5 or 1e3");
    return number;
}

/// The numbers of a tuple or size that has just so many.
std::vector<double> part_numbers(const Field& field, const Item& item, std::size_t count,
                                 std::string_view form, const Range& range)
{
    if (item.parts.size() != count)
        fail_kind(field, item.at,
                  std::to_string(count) + " numbers, not " + std::to_string(item.parts.size()),
                  form);
    std::vector<double> numbers;
    numbers.reserve(count);
    for (const Word& part : item.parts) {
        numbers.push_back(to_number(field, part));
        check_range(field, part.at, numbers.back(), range);
    }
    return numbers;
}

Vec3 to_vector(const std::vector<double>& numbers)
{
    return {numbers[0], numbers[1], numbers[2]};
}

Vec3 read_point(const Field& field)
{
    return to_vector(read_numbers(field, 3, "(0, 1, 2)"));
}

void append_vector(std::string& out, const Vec3& v)
{
    append(out, std::span<const double>(&v.x, 3));
}

Rgb item_color(const Field& field, const Item& item, std::string_view form)
{
    if (item.kind == ItemKind::tuple && item.text == "rgb")
        return to_vector(part_numbers(field, item, 3, form, share));
    if (item.kind == ItemKind::tuple && item.text.empty())
        return to_vector(part_numbers(field, item, 3, form, byte_range)) / 255.0;
    fail_kind(field, item.at, "a colour", form);
}

void append_color(std::string& out, const Rgb& color)
{
    for (int channel = 0; channel < 3; ++channel)
        if (!share.contains(color[channel]))
            throw std::invalid_argument("a colour outside 0 to 1 can't be written as a scene");
    out += "rgb";
    append_vector(out, color);
}

Rgb read_factor(const Field& field)
{
    constexpr std::string_view wanted = "a number or one for each channel";
    const Item& item = only_item(field, ItemKind::word, ItemKind::tuple, wanted, factor_form);
    if (item.kind == ItemKind::word)
        return Rgb(read_number(field, not_negative));
    if (item.text != "rgb" && !item.text.empty())
        fail_kind(field, item.at, wanted, factor_form);
    return to_vector(
        part_numbers(field, item, 3, factor_form, item.text.empty() ? not_negative : share));
}

std::string read_name(const Field& field)
{
    const Item& item = only_item(field, ItemKind::word, ItemKind::text, "a name", "\"the name\"");
    if (item.text.empty())
        fail(field.source, item.at, "the name is empty; write one or remove the key");
    return std::string(item.text);
}

void append_name(std::string& out, std::string_view name)
{
    for (const char c : name)
        if (c == '"' || static_cast<unsigned char>(c) < 0x20u || c == 0x7f)
            throw std::invalid_argument(
                "a name with quotes or control characters can't be written as a scene");
    (out += '"').append(name) += '"';
}

CheckerValue read_checker(const Field& field)
{
    constexpr std::string_view form = "(255, 255, 255), (0, 0, 0), 1";
    const std::vector<Item>& items = field.entry.value;
    if (items.size() != 3)
        field.fail("'checker' wants two colours and a size; write checker = " + std::string(form));
    CheckerValue value;
    value.color = item_color(field, items[0], form);
    value.checker.other = item_color(field, items[1], form);
    if (items[2].kind != ItemKind::word)
        fail_kind(field, items[2].at, "a number", form);
    value.checker.size = to_number(field, {items[2].at, items[2].text});
    if (!(value.checker.size > 0.0))
        fail(field.source, items[2].at, "the checker's size is not above 0; use a longer edge");
    return value;
}

}  // namespace

bool Range::contains(double number) const
{
    if (whole && number != std::floor(number))
        return false;
    const bool inside = open ? number > low && number < high : number >= low && number <= high;
    return inside || (!except.empty() && except.starts_with(to_text(number) + ' '));
}

std::string Range::text() const
{
    const double greatest = std::numeric_limits<double>::max();
    std::string text;
    if (high == greatest)
        text = low == -greatest ? ""
               : open           ? "above " + to_text(low)
                                : "of " + to_text(low) + " or more";
    else
        text = (open ? "above " : "from ") + to_text(low) + (open ? " and below " : " to ") +
               to_text(high);
    return except.empty() ? text : text + ", or " + std::string(except);
}

void check_range(const Field& field, Position at, double number, const Range& range)
{
    if (range.contains(number))
        return;
    const bool vowel = std::string_view("aeiou").find(range.noun[0]) != std::string_view::npos;
    fail(field.source, at,
         quote(field.entry.key.text) + (range.part.empty() ? " is " : " has ") +
             std::string(range.part) + to_text(number) + std::string(range.unit) + "; use " +
             (range.whole ? "a whole "
              : vowel     ? "an "
                          : "a ") +
             std::string(range.noun) + ' ' + range.text());
}

bool is_word(const Field& field)
{
    return field.entry.kind == EntryKind::value && field.entry.value[0].kind == ItemKind::word;
}

double read_number(const Field& field, const Range& range)
{
    const Item& item = only_item(field, ItemKind::word, range.whole ? "a whole number" : "a number",
                                 range.whole ? to_text(range.high) : "0.5");
    const double number = to_number(field, {item.at, item.text});
    check_range(field, item.at, number, range);
    return number;
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

void append(std::string& out, double number)
{
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, number);
    out.append(buffer, end);
}

void append(std::string& out, std::span<const double> numbers)
{
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        out += i == 0 ? '(' : ',';
        append(out, numbers[i]);
    }
    out += ')';
}

std::string to_text(double number)
{
    char buffer[32];
    const bool whole = std::abs(number) < 1e15 && number == std::floor(number);
    const auto format = whole ? std::chars_format::fixed : std::chars_format::general;
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, number, format);
    return error == std::errc{} ? std::string(buffer, end) : std::string("?");
}

Type<double> number(const Range& range)
{
    std::string takes(range.noun);
    if (const std::string limits = range.text(); !limits.empty())
        takes += ' ' + limits;
    return {takes, [range](const Field& field) { return read_number(field, range); },
            [](std::string& out, double value) { append(out, value); }};
}

Type<int> whole_number(int low, int high)
{
    const Range range{.low = 1.0 * low, .high = 1.0 * high, .whole = true};
    return {"whole number " + range.text(),
            [range](const Field& field) { return static_cast<int>(read_number(field, range)); },
            [](std::string& out, int value) { out += std::to_string(value); }};
}

Type<Vec3> point()
{
    return {"point", read_point, append_vector};
}

Type<std::vector<Vec3>> points()
{
    return {"points",
            [](const Field& field) {
                constexpr std::string_view form = "(0, 0, 3), (1, 0, 3), (0, 1, 3)";
                if (field.entry.kind != EntryKind::value)
                    fail_kind(field, field.entry.key.at, "points, not a block", form);
                std::vector<Vec3> points;
                for (const Item& item : field.entry.value) {
                    if (item.kind != ItemKind::tuple || !item.text.empty())
                        fail_kind(field, item.at, "points in brackets", form);
                    points.push_back(to_vector(part_numbers(field, item, 3, form, any_number)));
                }
                return points;
            },
            [](std::string& out, const std::vector<Vec3>& points) {
                for (std::size_t i = 0; i < points.size(); ++i) {
                    out += i == 0 ? "" : ",";
                    append_vector(out, points[i]);
                }
            }};
}

Type<Vec3> direction()
{
    return {"direction",
            [](const Field& field) {
                const Vec3 direction = read_point(field);
                if (direction == Vec3(0.0))
                    fail(field.source, field.entry.value[0].at,
                         quote(field.entry.key.text) +
                             " is (0, 0, 0), which points nowhere; "
                             "use a vector of any other length");
                return direction;
            },
            append_vector};
}

Type<Vec2> pair(const Range& range)
{
    return {"two numbers " + range.text(),
            [range](const Field& field) {
                const std::vector<double> numbers = read_numbers(field, 2, "(0.5, 1)", range);
                return Vec2(numbers[0], numbers[1]);
            },
            [](std::string& out, const Vec2& v) { append(out, std::span<const double>(&v.x, 2)); }};
}

Type<Vec2> size(Range range)
{
    range.part = "a side of ";
    return {(range.whole ? "size of whole numbers " : "size of numbers ") + range.text(),
            [range](const Field& field) {
                constexpr std::string_view form = "4 x 3";
                const Item& item = only_item(field, ItemKind::size, "a width and a height", form);
                const std::vector<double> sides = part_numbers(field, item, 2, form, range);
                return Vec2(sides[0], sides[1]);
            },
            [](std::string& out, const Vec2& v) {
                append(out, v.x);
                append(out += " x ", v.y);
            }};
}

Type<ZRange> z_range()
{
    return {"`(low, high)`, low below high",
            [](const Field& field) {
                const std::vector<double> ends = read_numbers(field, 2, "(0.5, 1)");
                if (!(ends[0] < ends[1]))
                    fail(field.source, field.entry.value[0].at,
                         "'z_range' is (" + to_text(ends[0]) + ", " + to_text(ends[1]) +
                             "), upside down or empty; write the lower end first, then a higher "
                             "one");
                return ZRange{ends[0], ends[1]};
            },
            [](std::string& out, const ZRange& range) {
                append(out, std::array{range.low, range.high});
            }};
}

Type<Rgb> color()
{
    return {"colour",
            [](const Field& field) {
                return item_color(field, only_item(field, ItemKind::tuple, "a colour", color_form),
                                  color_form);
            },
            append_color};
}

Type<Rgb> factor()
{
    return {"factor", read_factor, [](std::string& out, const Rgb& value) {
                if (value == Rgb(value.x))
                    append(out, value.x);
                else
                    append_vector(out, value);
            }};
}

Type<std::string> name()
{
    return {"name", read_name, append_name};
}

Type<CheckerValue> checker()
{
    return {"colour, colour, number above 0", read_checker,
            [](std::string& out, const CheckerValue& value) {
                append_color(out, value.color);
                append_color(out += ',', value.checker.other);
                append(out += ',', value.checker.size);
            }};
}

}  // namespace packtrace::language
