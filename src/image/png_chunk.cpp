#include "image/png_chunk.hpp"

#include <libdeflate.h>

#include <utility>

#include <packtrace/image_io.hpp>

namespace packtrace {

PngChunk::PngChunk(std::string_view type) : bytes_(4)
{
    for (const char letter : type)
        bytes_.push_back(static_cast<std::uint8_t>(letter));
}

void PngChunk::append(std::span<const std::uint8_t> data)
{
    bytes_.insert(bytes_.end(), data.begin(), data.end());
}

void PngChunk::append_number(std::size_t number)
{
    for (const int shift : {24, 16, 8, 0})
        bytes_.push_back(static_cast<std::uint8_t>(number >> shift));
}

Bytes& PngChunk::data()
{
    return bytes_;
}

Bytes PngChunk::finish() &&
{
    // Length and type stand before the data; the checksum is of type and data.
    const std::size_t length = bytes_.size() - 8;
    if (length > 0x7fffffff)
        throw ImageError("a row is too long for a PNG; use .pfm or .hdr");
    for (std::size_t i = 0; i < 4; ++i)
        bytes_[i] = static_cast<std::uint8_t>(length >> (24 - 8 * i));
    append_number(libdeflate_crc32(0, bytes_.data() + 4, length + 4));
    return std::move(bytes_);
}

}  // namespace packtrace
