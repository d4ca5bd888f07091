#include "scene/language/syntax_tree.hpp"

#include "scene/language/quote.hpp"

#include <algorithm>
#include <string>

namespace packtrace::language {
namespace {

/// The one block with a name before its brace.
constexpr std::string_view named_block = "material";

}  // namespace

bool contains(const Keys& keys, std::string_view key)
{
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

void add(Keys& keys, const Keys& more)
{
    keys.insert(keys.end(), more.begin(), more.end());
}

void Field::fail(const std::string& message) const
{
    language::fail(source, entry.key.at, message);
}

void Field::refuse(Position at, const std::string& message) const
{
    language::fail(source, at, subject.empty() ? message : std::string(subject) + ": " + message);
}

Block::Block(const Field& field, std::string_view title, const Keys& once, const Keys& repeatable)
    : field_(field), title_(title)
{
    check_block();
    check_keys(once, repeatable);
}

void Block::check_block() const
{
    const std::string key(title_);
    if (field_.entry.kind != EntryKind::block)
        field_.fail("'" + key + "' is a block, not a value; write " + key +
                    (key == named_block ? " gold { ... }" : " { ... }"));
    if (field_.entry.name && key != named_block)
        language::fail(field_.source, field_.entry.name->at,
                       "only a material is named before its brace; write name = \"...\" between "
                       "the braces of an object");
}

void Block::check_keys(const Keys& once, const Keys& repeatable) const
{
    std::vector<const Entry*> seen;
    for (const Entry& entry : field_.entry.entries) {
        const std::string_view key = entry.key.text;
        if (contains(repeatable, key))
            continue;
        if (!contains(once, key)) {
            Keys known = once;
            known.insert(known.end(), repeatable.begin(), repeatable.end());
            language::fail(field_.source, entry.key.at,
                           "unknown key " + quote(key) + " in " + std::string(title_) + "; " +
                               suggest(key, known));
        }
        for (const Entry* earlier : seen)
            if (earlier->key.text == key)
                language::fail(field_.source, entry.key.at,
                               quote(key) + " is given twice, first on line " +
                                   std::to_string(earlier->key.at.line) + "; remove one of them");
        seen.push_back(&entry);
    }
}

std::optional<Field> Block::find(std::string_view key) const
{
    for (const Entry& entry : field_.entry.entries)
        if (entry.key.text == key)
            return Field{field_.source, entry, field_.subject};
    return std::nullopt;
}

void Block::fail_missing(std::string_view key, std::string_view example) const
{
    const std::string name(key);
    field_.fail(std::string(title_) + " has no '" + name + "'; add for example " + name + " = " +
                std::string(example));
}

std::vector<Field> Block::fields() const
{
    std::vector<Field> result;
    for (const Entry& entry : field_.entry.entries)
        result.push_back({field_.source, entry, field_.subject});
    return result;
}

}  // namespace packtrace::language
