#pragma once

#include "scene/language/source.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The syntax tree of a scene: entries, and blocks whose keys have been checked.
namespace packtrace::language {

/// A run of letters, digits and `_ . + -`. Its reader decides whether it is a number, a key or a
/// name.
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

/// One item of a value, which is a comma-separated list.
struct Item {
    ItemKind kind = ItemKind::word;
    Position at;
    std::string_view text;    ///< the word, the quoted text, or the text before a tuple's '('
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

/// Parses the whole file into one block without a key. Views point into `source.text`. Throws
/// SceneError at the first syntax error.
[[nodiscard]] Entry parse_tree(const Source& source);

/// One `key = value` or `key { … }`, with its source for messages.
struct Field {
    const Source& source;
    const Entry& entry;
    std::string_view subject{};  ///< the owner of the value, for messages: "sphere 3"

    /// Throws SceneError at the key.
    [[noreturn]] void fail(const std::string& message) const;
    /// Throws SceneError for a value that a scene built in code may have, too. The message is that
    /// of validate().
    [[noreturn]] void refuse(Position at, const std::string& message) const;
};

/// A list of keys. They view string literals.
using Keys = std::vector<std::string_view>;

[[nodiscard]] bool contains(const Keys& keys, std::string_view key);
void add(Keys& keys, const Keys& more);

/// A block whose keys have been checked: each is known, and occurs once unless it is repeatable.
class Block {
public:
    /// `title` names the block in messages: "sphere". Throws SceneError at a key that is neither in
    /// `once` nor in `repeatable`, and at a second occurrence of a key that is not in `repeatable`.
    Block(const Field& field, std::string_view title, const Keys& once,
          const Keys& repeatable = {});

    [[nodiscard]] std::optional<Field> find(std::string_view key) const;
    /// Throws SceneError: the key is missing. The message shows `example` as a value.
    [[noreturn]] void fail_missing(std::string_view key, std::string_view example) const;
    /// All entries, in the order of the file.
    [[nodiscard]] std::vector<Field> fields() const;

    [[nodiscard]] const Field& field() const
    {
        return field_;
    }

    /// Sets the subject of messages about values. Keeps the view `subject`.
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
