#pragma once

#include <string>

#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include "scene/language/words.hpp"
#include "values.hpp"

// The words that stand for values of enumerations: those of the scene language and of the program.
namespace packtrace::python {

using language::Spelling;
using language::spellings;

constexpr std::array<Spelling<Kernel>, 2> spellings(Kernel)
{
    return {{{Kernel::packet, "packet"}, {Kernel::scalar, "scalar"}}};
}

constexpr std::array<Spelling<Accuracy>, 2> spellings(Accuracy)
{
    return {{{Accuracy::fast, "fast"}, {Accuracy::exact, "exact"}}};
}

constexpr std::array<Spelling<SelfHits>, 2> spellings(SelfHits)
{
    return {{{SelfHits::note, "note"}, {SelfHits::exact, "exact"}}};
}

constexpr std::array<Spelling<Traversal>, 3> spellings(Traversal)
{
    return {{{Traversal::automatic, "auto"}, {Traversal::list, "list"}, {Traversal::tree, "tree"}}};
}

inline std::vector<Spelling<QuadricKind>> spellings(QuadricKind)
{
    std::vector<Spelling<QuadricKind>> words;
    for (const QuadricKindInfo& info : quadric_kinds())
        words.push_back({info.kind, info.name});
    words.push_back({QuadricKind::general, "general"});
    return words;
}

/// The value that a word stands for.
template <class Enum>
[[nodiscard]] Enum word_value(py::handle value, const std::string& key)
{
    std::string all;
    for (const Spelling<Enum>& spelling : spellings(Enum{})) {
        if (PyUnicode_Check(value.ptr()) != 0 && value.cast<std::string>() == spelling.word)
            return spelling.value;
        all += (all.empty() ? "'" : ", '") + std::string(spelling.word) + "'";
    }
    throw_wrong(key, value, "one of " + all);
}

/// The word that stands for a value.
template <class Enum>
[[nodiscard]] std::string value_word(Enum value)
{
    for (const Spelling<Enum>& spelling : spellings(value))
        if (spelling.value == value)
            return std::string(spelling.word);
    return {};
}

}  // namespace packtrace::python
