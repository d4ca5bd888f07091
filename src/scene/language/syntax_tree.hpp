#pragma once

#include "scene/language/source.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// A scene as its grammar sees it: entries, and blocks whose keys have been checked.
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

/// One `key = value` or `key { … }` with the source it came from, for messages.
struct Field {
    const Source& source;
    const Entry& entry;
    std::string_view subject{};  ///< what a wrong value belongs to: "sphere 3"

    /// Throws SceneError at the key.
    [[noreturn]] void fail(const std::string& message) const;
    /// Throws SceneError for a value that a scene built in code can have as well, with the words
    /// that validate() has for it.
    [[noreturn]] void refuse(Position at, const std::string& message) const;
};

/// A list of keys; the literals behind them live for ever.
using Keys = std::vector<std::string_view>;

[[nodiscard]] bool contains(const Keys& keys, std::string_view key);
void add(Keys& keys, const Keys& more);

/// A block whose keys have been checked: each is known, and given once unless repeatable.
class Block {
public:
    /// `title` names the block in messages: "sphere". Throws SceneError at a key that is
    /// neither in `once` nor in `repeatable`, or is given twice and not in the latter.
    Block(const Field& field, std::string_view title, const Keys& once,
          const Keys& repeatable = {});

    [[nodiscard]] std::optional<Field> find(std::string_view key) const;
    /// Throws SceneError as the key is missing; `example` is a value for the message.
    [[noreturn]] void fail_missing(std::string_view key, std::string_view example) const;
    /// All entries, in the order written.
    [[nodiscard]] std::vector<Field> fields() const;

    [[nodiscard]] const Field& field() const
    {
        return field_;
    }

    /// Names what the block is about, for messages; `subject` is kept.
    void set_subject(std::string_view subject)
    {
        field_.subject = subject;
    }

private:
    void check_block() const;
    void check_keys(const Keys& once, const Keys& repeatable) const;

    Field field_;
    std::string_view title_;
};

}  // namespace packtrace::language
