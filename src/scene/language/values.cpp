#include "scene/language/values.hpp"

#include "scene/language/quote.hpp"
#include "scene/vectors.hpp"

#include <cmath>

namespace packtrace::language {
namespace {

constexpr std::string_view color_form = "(255, 128, 0) or rgb(1, 0.5, 0)";
constexpr std::string_view factor_form = "0.5 or (0.5, 0.4, 0.3)";
constexpr Range byte_range{.low = 0.0, .high = 255.0};
constexpr Range any_size{.largest = std::numeric_limits<double>::max()};

std::span<const double> numbers_of(const Vec3& v)
{
    return {&v.x, 3};
}

Vec3 read_point(const Field& field)
{
    return to_vector(read_numbers(field, 3, "(0, 1, 2)"));
}

void append_vector(std::string& out, const Vec3& v)
{
    append(out, numbers_of(v));
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
    out += "rgb";
    append_vector(out, color);
}

Rgb read_factor(const Field& field)
{
    constexpr std::string_view wanted = "a number or one for each channel";
    const Item& item = only_item(field, ItemKind::word, ItemKind::tuple, wanted, factor_form);
    if (item.kind == ItemKind::word)
        return Rgb(read_number(field, any_factor));
    if (item.text != "rgb" && !item.text.empty())
        fail_kind(field, item.at, wanted, factor_form);
    return to_vector(
        part_numbers(field, item, 3, factor_form, item.text.empty() ? any_factor : share));
}

Fault fault_of_name(std::string_view key, std::string_view name)
{
    if (name.empty())
        return "the name is empty; write one or remove the key";
    const auto odd = [](char c) {
        return c == '"' || (static_cast<unsigned char>(c) < 0x20u && c != '\t') || c == 0x7f;
    };
    if (std::any_of(name.begin(), name.end(), odd))
        return quote(key) + " is " + quote(name) +
               ", which no scene file can hold; leave out quotation marks and control characters";
    if (name.size() > longest_name)
        return quote(key) + " is " + quote(name) + ", of " + std::to_string(name.size()) +
               " bytes; use at most " + std::to_string(longest_name);
    return std::nullopt;
}

std::string read_name(const Field& field)
{
    const Item& item = only_item(field, ItemKind::word, ItemKind::text, "a name", "\"the name\"");
    if (const Fault fault = fault_of_name(field.entry.key.text, item.text))
        field.refuse(item.at, *fault);
    return std::string(item.text);
}

void append_name(std::string& out, std::string_view name)
{
    (out += '"').append(name) += '"';
}

Fault fault_of_zero(std::string_view key, const Vec3& direction)
{
    if (direction == Vec3(0.0))
        return quote(key) + " is (0, 0, 0), which points nowhere; use a vector of any other length";
    return std::nullopt;
}

Fault fault_of_direction(std::string_view key, const Vec3& direction)
{
    if (Fault fault = fault_of_zero(key, direction))
        return fault;
    if (Fault fault = fault_of(key, direction, any_number))
        return fault;
    return fault_of(key, largest_component(direction), any_length);
}

Fault fault_of_unit(std::string_view key, const Vec3& direction)
{
    if (Fault fault = fault_of_zero(key, direction))
        return fault;
    if (Fault fault = fault_of(key, direction, any_size))
        return fault;
    if (!is_unit(direction))
        return quote(key) + " has the length " + to_text(glm::length(direction)) +
               "; make it 1, as plane() does";
    return std::nullopt;
}

Fault fault_of_z_range(std::string_view key, const ZRange& range)
{
    if (Fault fault = fault_of(key, std::array{range.low, range.high}, any_number))
        return fault;
    if (range.low < range.high)
        return std::nullopt;
    return quote(key) + " is (" + to_text(range.low) + ", " + to_text(range.high) +
           "), upside down or empty; write the lower end first, then a higher one";
}

Fault fault_of_points(std::string_view key, const std::vector<Vec3>& points)
{
    if (points.size() > most_points)
        return quote(key) + " has " + std::to_string(points.size()) + " points; use at most " +
               std::to_string(most_points);
    for (const Vec3& point : points)
        if (Fault fault = fault_of(key, point, any_number))
            return fault;
    return std::nullopt;
}

Fault fault_of_squares(std::string_view key, const CheckerValue& value)
{
    for (const Rgb& color : {value.color, value.checker.other})
        if (Fault fault = fault_of(key, color, share))
            return fault;
    return fault_of(key, value.checker.size, any_length);
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
    value.checker.size = item_number(field, items[2], any_length);
    return value;
}

}  // namespace

Type<double> number(const Range& range)
{
    std::string takes(range.noun);
    if (const std::string limits = range.text(); !limits.empty())
        takes += ' ' + limits;
    return {takes, [range](const Field& field) { return read_number(field, range); },
            [](std::string& out, double value) { append(out, value); },
            [range](std::string_view key, double value) { return fault_of(key, value, range); }};
}

Type<int> whole_number(int low, int high)
{
    const Range range{.low = 1.0 * low, .high = 1.0 * high, .whole = true};
    return {"whole number " + range.text(),
            [range](const Field& field) { return static_cast<int>(read_number(field, range)); },
            [](std::string& out, int value) { out += std::to_string(value); },
            [range](std::string_view key, int value) { return fault_of(key, value, range); }};
}

Type<Vec3> point()
{
    return {"point", read_point, append_vector, [](std::string_view key, const Vec3& point) {
                return fault_of(key, point, any_number);
            }};
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
                // Several lines, because a line has a maximum length.
                constexpr std::size_t points_in_line = 256;
                for (std::size_t i = 0; i < points.size(); ++i) {
                    out += i == 0 ? "" : i % points_in_line == 0 ? ",\n" : ",";
                    append_vector(out, points[i]);
                }
            },
            fault_of_points};
}

Type<Vec3> direction()
{
    return {"direction",
            [](const Field& field) {
                const Vec3 direction = read_point(field);
                if (const Fault fault = fault_of_direction(field.entry.key.text, direction))
                    field.refuse(field.entry.value[0].at, *fault);
                return direction;
            },
            append_vector, fault_of_direction};
}

Type<Vec3> unit_direction()
{
    return {"direction",
            [](const Field& field) {
                const Vec3 direction = to_vector(read_numbers(field, 3, "(0, 1, 2)", any_size));
                if (const Fault fault = fault_of_zero(field.entry.key.text, direction))
                    field.refuse(field.entry.value[0].at, *fault);
                // A unit vector keeps its digits when it is written and read again.
                return is_unit(direction) ? direction : unit_vector(direction);
            },
            append_vector, fault_of_unit};
}

Type<Vec2> pair(const Range& range)
{
    return {"two numbers " + range.text(),
            [range](const Field& field) {
                const std::vector<double> numbers = read_numbers(field, 2, "(0.5, 1)", range);
                return Vec2(numbers[0], numbers[1]);
            },
            [](std::string& out, const Vec2& v) { append(out, std::span<const double>(&v.x, 2)); },
            [range](std::string_view key, const Vec2& v) {
                return fault_of(key, std::span<const double>(&v.x, 2), range);
            }};
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
            },
            [range](std::string_view key, const Vec2& v) {
                return fault_of(key, std::span<const double>(&v.x, 2), range);
            }};
}

Type<ZRange> z_range()
{
    return {"`(low, high)`, low below high",
            [](const Field& field) {
                const std::vector<double> ends = read_numbers(field, 2, "(0.5, 1)");
                const ZRange range{ends[0], ends[1]};
                if (const Fault fault = fault_of_z_range(field.entry.key.text, range))
                    field.refuse(field.entry.value[0].at, *fault);
                return range;
            },
            [](std::string& out, const ZRange& range) {
                append(out, std::array{range.low, range.high});
            },
            fault_of_z_range};
}

Type<Rgb> color()
{
    return {"colour",
            [](const Field& field) {
                return item_color(field, only_item(field, ItemKind::tuple, "a colour", color_form),
                                  color_form);
            },
            append_color,
            [](std::string_view key, const Rgb& value) { return fault_of(key, value, share); }};
}

Type<Rgb> factor()
{
    return {
        "factor", read_factor,
        [](std::string& out, const Rgb& value) {
            if (value == Rgb(value.x))
                append(out, value.x);
            else
                append_vector(out, value);
        },
        [](std::string_view key, const Rgb& value) { return fault_of(key, value, any_factor); }};
}

Type<std::string> name()
{
    return {"name", read_name, append_name, fault_of_name};
}

Type<CheckerValue> checker()
{
    return {"colour, colour, number above 0", read_checker,
            [](std::string& out, const CheckerValue& value) {
                append_color(out, value.color);
                append_color(out += ',', value.checker.other);
                append(out += ',', value.checker.size);
            },
            fault_of_squares};
}

}  // namespace packtrace::language
