#pragma once

#include "scene/source.hpp"
#include "scene/syntax_tree.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace packtrace::reader {

/// Grows the syntax tree while the grammar matches; its calls follow the text from left to right.
class TreeBuilder {
public:
    explicit TreeBuilder(const Source& source);

    void begin_entry(Word key);
    void open_block(Position brace);
    void name_block(Word name);
    void end_entry();

    void add_item(ItemKind kind, Word word);
    /// Another part of the last item, which is a tuple or size.
    void add_part(Word part);

    [[nodiscard]] const Source& source() const;
    [[nodiscard]] std::string_view current_key() const;
    /// Where the innermost open block's brace stands.
    [[nodiscard]] Position open_brace() const;
    [[nodiscard]] Entry take();

private:
    void check_room(std::size_t count, std::size_t limit, Position at, const char* things) const;

    const Source& source_;
    std::vector<Entry> open_;  ///< the file, then what is being read in it, outermost first
    std::vector<Position> braces_;
    std::size_t entries_ = 0;  ///< in the file so far
};

}  // namespace packtrace::reader
