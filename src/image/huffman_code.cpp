#include "image/huffman_code.hpp"

#include <algorithm>

namespace packtrace {
namespace {

// Codes stand in the stream from their highest bit.
unsigned reversed(unsigned code, unsigned length)
{
    unsigned result = 0;
    for (unsigned i = 0; i < length; ++i)
        result |= (code >> i & 1u) << (length - 1 - i);
    return result;
}

}  // namespace

HuffmanCode::HuffmanCode(std::span<const std::uint8_t> lengths, unsigned (*extra_bits)(unsigned))
{
    const unsigned longest = *std::max_element(lengths.begin(), lengths.end());
    table_.resize(std::size_t{1} << longest);
    mask_ = table_.size() - 1;
    unsigned code = 0;
    for (unsigned length = 1; length <= longest; ++length, code <<= 1)
        for (unsigned symbol = 0; symbol < lengths.size(); ++symbol)
            if (lengths[symbol] == length)
                add({static_cast<std::uint16_t>(symbol), static_cast<std::uint8_t>(length),
                     static_cast<std::uint8_t>(length + extra_bits(symbol))},
                    code++);
}

void HuffmanCode::add(Entry entry, unsigned code)
{
    for (std::size_t i = reversed(code, entry.length); i < table_.size(); i += 1u << entry.length)
        table_[i] = entry;
}

}  // namespace packtrace
