#pragma once

#include "scene/source.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace packtrace::language {

/// A run of letters, digits and `_ . + -`: a number, a key or a name, told apart by its reader.
struct Word {
    Position at;
    std::string_view text;
};

enum class ItemKind {
    word,   ///< scratch   0.5
    text,   ///< "in quotes"
    tuple,  ///< (1, 2, 3)   rgb(1, 2, 3)
    size    ///< 640 x 480
};

/// One item of the comma-separated list that a value is.
struct Item {
    ItemKind kind = ItemKind::word;
    Position at;
    std::string_view text;    ///< the word, the quoted text, or what stands before a tuple's '('
    std::vector<Word> parts;  ///< of a tuple or size
};

enum class EntryKind {
    value,  ///< key = value
    block   ///< key { … }   key name { … }
};

struct Entry {
    EntryKind kind = EntryKind::value;
    Word key;
    std::optional<Word> name;    ///< before a block's brace
    std::vector<Item> value;     ///< at least one item for EntryKind::value
    std::vector<Entry> entries;  ///< of a block
};

/// The whole file as one block without a key. Views point into `source.text`. Throws
/// SceneError at the first place that breaks the grammar.
[[nodiscard]] Entry parse_tree(const Source& source);

}  // namespace packtrace::language
