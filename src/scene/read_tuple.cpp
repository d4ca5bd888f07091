#include "scene/numbers.hpp"
#include "scene/quote.hpp"
#include "scene/values.hpp"

#include <string>

namespace packtrace::reader {

std::vector<double> read_numbers(const Field& field, std::size_t count, std::string_view form)
{
    const Item& item = only_item(field, ItemKind::tuple, "numbers in brackets", form);
    if (!item.text.empty())
        fail_kind(field, item.at, "numbers in brackets only", form);
    return part_numbers(field, item, count, form);
}

Vec3 read_point(const Field& field)
{
    const std::vector<double> numbers = read_numbers(field, 3, "(0, 1, 2)");
    return {numbers[0], numbers[1], numbers[2]};
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
    const std::vector<double> numbers = read_numbers(field, 2, "(0.5, 1)");
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

}  // namespace packtrace::reader
