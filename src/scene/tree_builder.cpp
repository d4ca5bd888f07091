#include "scene/tree_builder.hpp"

#include <utility>

namespace packtrace {

TreeBuilder::TreeBuilder(const Source& source) : source_(source), open_(1)
{
    open_[0].kind = EntryKind::block;
}

void TreeBuilder::begin_entry(Word key)
{
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
    open_.back().value.push_back({kind, word.at, word.text, {}});
}

void TreeBuilder::add_part(Word part)
{
    open_.back().value.back().parts.push_back(part);
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

}  // namespace packtrace
