#include "scene/values.hpp"

namespace packtrace::reader {
namespace {

constexpr std::string_view color_form = "(255, 128, 0) or rgb(1, 0.5, 0)";
constexpr std::string_view factor_form = "0.5 or (0.5, 0.4, 0.3)";

Rgb channels_in(const Field& field, const Item& item, Range range, std::string_view form)
{
    const std::vector<double> channels = part_numbers(field, item, 3, form);
    for (std::size_t i = 0; i < 3; ++i)
        check_range(field, item.parts[i].at, channels[i], range);
    return {channels[0], channels[1], channels[2]};
}

}  // namespace

Rgb item_color(const Field& field, const Item& item, std::string_view form)
{
    if (item.kind == ItemKind::tuple && item.text == "rgb")
        return channels_in(field, item, {0.0, 1.0}, form);
    if (item.kind == ItemKind::tuple && item.text.empty())
        return channels_in(field, item, {0.0, 255.0}, form) / 255.0;
    fail_kind(field, item.at, "a colour", form);
}

Rgb read_color(const Field& field)
{
    const Item& item = only_item(field, ItemKind::tuple, "a colour", color_form);
    return item_color(field, item, color_form);
}

Rgb read_factor(const Field& field)
{
    constexpr std::string_view wanted = "a number or one for each channel";
    const Item& item = only_item(field, ItemKind::word, ItemKind::tuple, wanted, factor_form);
    if (item.kind == ItemKind::word)
        return Rgb(read_not_negative(field));
    if (item.text == "rgb")
        return channels_in(field, item, {0.0, 1.0}, factor_form);
    if (item.text.empty())
        return channels_in(field, item, not_negative, factor_form);
    fail_kind(field, item.at, wanted, factor_form);
}

}  // namespace packtrace::reader
