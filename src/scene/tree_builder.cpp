#include "scene/tree_builder.hpp"

#include <string>
#include <utility>

namespace packtrace::reader {
namespace {

// A tree takes far more memory than its text. These bound it for a text that is no scene: no
// key takes as many numbers, and no scene of the largest size has as many keys.
constexpr std::size_t most_items = 64;
constexpr std::size_t most_entries = 8'000'000;

}  // namespace

void TreeBuilder::check_room(std::size_t count, std::size_t limit, Position at,
                             const char* things) const
{
    if (count >= limit)
        fail(source_, at, "more than " + std::to_string(limit) + ' ' + things + "; remove some");
}

TreeBuilder::TreeBuilder(const Source& source) : source_(source), open_(1)
{
    open_[0].kind = EntryKind::block;
}

void TreeBuilder::begin_entry(Word key)
{
    check_room(entries_++, most_entries, key.at, "keys in a file");
    Entry entry;
    entry.key = key;
    open_.push_back(std::move(entry));
}

void TreeBuilder::open_block(Position brace)
{
    open_.back().kind = EntryKind::block;
    braces_.push_back(brace);
}

void TreeBuilder::name_block(Word name)
{
    open_.back().name = name;
}

void TreeBuilder::end_entry()
{
    Entry entry = std::move(open_.back());
    open_.pop_back();
    if (entry.kind == EntryKind::block)
        braces_.pop_back();
    open_.back().entries.push_back(std::move(entry));
}

void TreeBuilder::add_item(ItemKind kind, Word word)
{
    std::vector<Item>& value = open_.back().value;
    check_room(value.size(), most_items, word.at, "items in a value");
    value.push_back({kind, word.at, word.text, {}});
}

void TreeBuilder::add_part(Word part)
{
    std::vector<Word>& parts = open_.back().value.back().parts;
    check_room(parts.size(), most_items, part.at, "numbers in a tuple");
    parts.push_back(part);
}

const Source& TreeBuilder::source() const
{
    return source_;
}

std::string_view TreeBuilder::current_key() const
{
    return open_.back().key.text;
}

Position TreeBuilder::open_brace() const
{
    return braces_.back();
}

Entry TreeBuilder::take()
{
    return std::move(open_.front());
}

}  // namespace packtrace::reader
