#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "image/bit_cursor.hpp"

namespace packtrace {

/// A canonical Huffman code of deflate (RFC 1951, 3.2.2), as a table from the next bits of a
/// stream to the symbol they begin with.
class HuffmanCode {
public:
    struct Entry {
        std::uint16_t symbol = 0;
        std::uint8_t length = 0;  ///< bits of the code; 0 where no code begins so
        std::uint8_t whole = 0;   ///< bits of the code and of the number that follows it
    };

    /// `lengths` has the bits of each symbol's code, 0 for none, 15 at most. `extra_bits` tells
    /// how many more follow a symbol.
    HuffmanCode(std::span<const std::uint8_t> lengths, unsigned (*extra_bits)(unsigned symbol));

    /// The symbol that the stream goes on with. Throws std::logic_error when there is none.
    [[nodiscard]] Entry at(const BitCursor& stream) const
    {
        const Entry entry = table_[stream.peek() & mask_];
        if (entry.length == 0)
            throw std::logic_error("a deflate stream has an unknown code");
        return entry;
    }

private:
    void add(Entry entry, unsigned code);

    std::vector<Entry> table_;
    std::uint64_t mask_ = 0;
};

}  // namespace packtrace
