#include "image/deflate_piece.hpp"

#include <libdeflate.h>

#include <new>

#include "image/deflate_end.hpp"

namespace packtrace {

DeflatePieces::DeflatePieces(int level)
    : compressor_(libdeflate_alloc_compressor(level), libdeflate_free_compressor)
{
    if (!compressor_)
        throw std::bad_alloc();
}

void DeflatePieces::append(std::span<const std::uint8_t> data, Bytes& to)
{
    // libdeflate writes whole streams only. This one's last block is made an inner one, and an
    // empty stored block after it (three zero bits, then 0 and ~0 in 16 bits) fills the byte.
    const std::size_t start = to.size();
    to.resize(start + libdeflate_deflate_compress_bound(compressor_.get(), data.size()));
    const std::size_t length = libdeflate_deflate_compress(
        compressor_.get(), data.data(), data.size(), to.data() + start, to.size() - start);
    const DeflateEnd place = find_deflate_end({to.data() + start, length});
    to[start + place.last_block / 8] &= static_cast<std::uint8_t>(~(1u << place.last_block % 8));
    to.resize(start + length);
    to.resize(start + (place.end + 3 + 7) / 8, 0);
    to.insert(to.end(), {0x00, 0x00, 0xff, 0xff});
}

Bytes last_deflate_piece()
{
    // BFINAL, fixed codes, end of block: 1, 01, 0000000.
    return {0x03, 0x00};
}

std::uint32_t join_adler32(std::uint32_t first, std::uint32_t second, std::size_t length)
{
    // Both halves are sums modulo 65521 (RFC 1950): a of the bytes from 1, b of the a.
    constexpr std::uint64_t modulus = 65521;
    const std::uint64_t a1 = first & 0xffffu;
    const std::uint64_t a2 = second & 0xffffu;
    const std::uint64_t a = (a1 + a2 + modulus - 1) % modulus;
    const std::uint64_t carried = length % modulus * (a1 + modulus - 1);
    const std::uint64_t b = ((first >> 16) + (second >> 16) + carried) % modulus;
    return static_cast<std::uint32_t>(b << 16 | a);
}

}  // namespace packtrace
