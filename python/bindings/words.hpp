#pragma once

#include "core/text.hpp"
#include "render/option_words.hpp"
#include "scene/language/words.hpp"
#include "values.hpp"
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <string>

// The words for values of enumerations, from the scene language and the program.
namespace packtrace::python {

using language::spellings;
using language::word_of;

/// The value of a word.
template <class Enum>
[[nodiscard]] Enum word_value(py::handle value, const std::string& key)
{
    if (const std::optional<std::string> word = text_of(value))
        if (const auto found = language::find_word<Enum>(*word))
            return *found;
    throw_wrong(key, value, "one of " + joined(spellings(Enum{}), ", ", [](const auto& spelling) {
                                return "'" + std::string(spelling.word) + "'";
                            }));
}

}  // namespace packtrace::python
