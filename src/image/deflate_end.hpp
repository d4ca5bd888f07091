#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace packtrace {

/// Where things stand in a raw deflate stream (RFC 1951), in bits from its start.
struct DeflateEnd {
    std::size_t last_block = 0;  ///< the last block's header, whose first bit is BFINAL
    std::size_t end = 0;         ///< one past the last block's end-of-block code
};

/// Walks the stream's codes without decoding its data. Throws std::logic_error for a stream
/// that is not deflate: it is meant for a compressor's own output.
[[nodiscard]] DeflateEnd find_deflate_end(std::span<const std::uint8_t> stream);

}  // namespace packtrace
