#include "image/deflate_end.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "image/bit_cursor.hpp"
#include "image/huffman_code.hpp"

namespace packtrace {
namespace {

constexpr unsigned end_of_block = 256;

// Bits that follow a symbol, in the three codes of deflate (RFC 1951, 3.2.5 and 3.2.7).
unsigned extra_of_literal(unsigned symbol)
{
    return symbol < 265 || symbol == 285 ? 0 : (symbol - 261) / 4;
}
unsigned extra_of_distance(unsigned symbol)
{
    return symbol < 4 ? 0 : symbol / 2 - 1;
}
unsigned extra_of_code_length(unsigned symbol)
{
    return symbol < 16 ? 0 : symbol == 16 ? 2 : symbol == 17 ? 3 : 7;
}

HuffmanCode take_code_of_lengths(BitCursor& stream)
{
    constexpr std::array<std::size_t, 19> order{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                11, 4,  12, 3, 13, 2, 14, 1, 15};
    std::array<std::uint8_t, 19> lengths{};
    const std::size_t listed = stream.take(4) + 4;
    for (std::size_t i = 0; i < listed; ++i)
        lengths[order[i]] = static_cast<std::uint8_t>(stream.take(3));
    return {lengths, extra_of_code_length};
}

// The lengths of a dynamic block's two codes, one after the other.
std::vector<std::uint8_t> take_lengths(BitCursor& stream, std::size_t count)
{
    const HuffmanCode code = take_code_of_lengths(stream);
    std::vector<std::uint8_t> lengths;
    while (lengths.size() < count) {
        const HuffmanCode::Entry entry = code.at(stream);
        stream.skip(entry.length);
        const std::uint32_t extra = stream.take(entry.whole - entry.length);
        // Up to 15 a length; 16 repeats the last one, 17 and 18 are runs of zeros.
        const bool repeats = entry.symbol == 16 && !lengths.empty();
        const auto length = static_cast<std::uint8_t>(repeats              ? lengths.back()
                                                      : entry.symbol >= 16 ? 0
                                                                           : entry.symbol);
        const std::size_t times = entry.symbol < 16 ? 1 : (entry.symbol == 18 ? 11 : 3) + extra;
        lengths.insert(lengths.end(), times, length);
    }
    return lengths;
}

void skip_codes(BitCursor& stream, const HuffmanCode& literals, const HuffmanCode& distances)
{
    for (;;) {
        const HuffmanCode::Entry entry = literals.at(stream);
        stream.skip(entry.whole);
        if (entry.symbol == end_of_block)
            return;
        if (entry.symbol > end_of_block)
            stream.skip(distances.at(stream).whole);
    }
}

void skip_stored(BitCursor& stream)
{
    stream.align();
    const std::size_t length = stream.take(16);
    stream.skip(16 + 8 * length);
}

void skip_fixed(BitCursor& stream)
{
    std::array<std::uint8_t, 288> literals{};
    std::fill(literals.begin(), literals.begin() + 144, std::uint8_t{8});
    std::fill(literals.begin() + 144, literals.begin() + 256, std::uint8_t{9});
    std::fill(literals.begin() + 256, literals.begin() + 280, std::uint8_t{7});
    std::fill(literals.begin() + 280, literals.end(), std::uint8_t{8});
    std::array<std::uint8_t, 30> distances{};
    distances.fill(5);
    skip_codes(stream, HuffmanCode(literals, extra_of_literal),
               HuffmanCode(distances, extra_of_distance));
}

void skip_dynamic(BitCursor& stream)
{
    const std::size_t literals = stream.take(5) + 257;
    const std::size_t distances = stream.take(5) + 1;
    const std::vector<std::uint8_t> lengths = take_lengths(stream, literals + distances);
    const std::span all(lengths);
    skip_codes(stream, HuffmanCode(all.first(literals), extra_of_literal),
               HuffmanCode(all.subspan(literals), extra_of_distance));
}

}  // namespace

DeflateEnd find_deflate_end(std::span<const std::uint8_t> stream)
{
    BitCursor cursor(stream);
    DeflateEnd result;
    for (bool last = false; !last;) {
        result.last_block = cursor.position();
        last = cursor.take(1) != 0;
        switch (cursor.take(2)) {
            case 0:
                skip_stored(cursor);
                break;
            case 1:
                skip_fixed(cursor);
                break;
            case 2:
                skip_dynamic(cursor);
                break;
            default:
                throw std::logic_error("a deflate stream has an unknown block");
        }
    }
    result.end = cursor.position();
    return result;
}

}  // namespace packtrace
