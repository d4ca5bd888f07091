#include "scene/nearest_word.hpp"
#include "scene/quote.hpp"
#include "scene/values.hpp"

#include <string>

namespace packtrace::reader {

std::string_view read_name(const Field& field)
{
    return only_item(field, ItemKind::word, ItemKind::text, "a name", "\"the name\"").text;
}

std::size_t read_choice(const Field& field, std::span<const std::string_view> choices)
{
    const Item& item = only_item(field, ItemKind::word, "one word", choices[0]);
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (choices[i] == item.text)
            return i;
    fail(field.source, item.at,
         "unknown " + std::string(field.entry.key.text) + " " + quote(item.text) + "; " +
             suggest(item.text, choices));
}

bool read_flag(const Field& field)
{
    static constexpr std::string_view choices[] = {"false", "true", "no", "yes"};
    return read_choice(field, choices) % 2 == 1;
}

}  // namespace packtrace::reader
