#pragma once

#include "scene/language/words.hpp"
#include <packtrace/render.hpp>

#include <array>

// The words for the values of render options, for the program and for Python.
namespace packtrace {

constexpr std::array<language::Spelling<Kernel>, 2> spellings(Kernel)
{
    return {{{Kernel::packet, "packet"}, {Kernel::scalar, "scalar"}}};
}

constexpr std::array<language::Spelling<Precision>, 3> spellings(Precision)
{
    return {{{Precision::single, "single"},
             {Precision::double_, "double"},
             {Precision::extended, "extended"}}};
}

constexpr std::array<language::Spelling<Accuracy>, 2> spellings(Accuracy)
{
    return {{{Accuracy::fast, "fast"}, {Accuracy::exact, "exact"}}};
}

constexpr std::array<language::Spelling<SelfHits>, 2> spellings(SelfHits)
{
    return {{{SelfHits::note, "note"}, {SelfHits::exact, "exact"}}};
}

constexpr std::array<language::Spelling<Traversal>, 3> spellings(Traversal)
{
    return {{{Traversal::automatic, "auto"}, {Traversal::list, "list"}, {Traversal::tree, "tree"}}};
}

}  // namespace packtrace
