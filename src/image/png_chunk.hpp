#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "image/bytes.hpp"

namespace packtrace {

/// A chunk of a PNG file: type and data, to which `bytes` adds length and checksum.
class PngChunk {
public:
    /// `type` has four letters.
    explicit PngChunk(std::string_view type);

    void append(std::span<const std::uint8_t> data);
    /// Four bytes, the highest first.
    void append_number(std::size_t number);

    /// The chunk to add data to where it lies; its first eight bytes are not to be touched.
    [[nodiscard]] Bytes& data();

    /// The chunk as it stands in the file. Throws ImageError for 2 GiB of data or more.
    [[nodiscard]] Bytes finish() &&;

private:
    Bytes bytes_;
};

}  // namespace packtrace
