#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

// Checksums of bytes and texts.
namespace packtrace {

[[nodiscard]] inline std::span<const std::uint8_t> bytes_of(std::string_view text)
{
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// The CRC-32 of bytes. `before` is the checksum of the bytes before them, if any.
[[nodiscard]] std::uint32_t checksum(std::span<const std::uint8_t> bytes, std::uint32_t before = 0);

/// FNV-1a (Fowler, Noll and Vo) with 64 bits. It is the same on every machine and in every version.
[[nodiscard]] constexpr std::uint64_t text_hash(std::string_view text)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char letter : text)
        hash = (hash ^ static_cast<std::uint8_t>(letter)) * 0x100000001b3u;
    return hash;
}

/// text_hash() as 16 hexadecimal digits.
[[nodiscard]] std::string text_hash_digits(std::string_view text);

}  // namespace packtrace
