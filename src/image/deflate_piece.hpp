#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "image/bytes.hpp"

struct libdeflate_compressor;

namespace packtrace {

/// Compresses pieces of one zlib stream apart from each other, so that threads may share it.
/// One compressor serves one thread.
class DeflatePieces {
public:
    /// `level` is libdeflate's, 1 (quick) to 12 (small).
    explicit DeflatePieces(int level);

    /// Appends `data` as deflate blocks none of which is the stream's last, ending at a byte.
    void append(std::span<const std::uint8_t> data, Bytes& to);

private:
    std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor_;
};

/// The empty block that ends a deflate stream after its pieces.
[[nodiscard]] Bytes last_deflate_piece();

/// Adler-32 of data whose first part has `first`, and whose second, `length` long, `second`.
[[nodiscard]] std::uint32_t join_adler32(std::uint32_t first, std::uint32_t second,
                                         std::size_t length);

}  // namespace packtrace
