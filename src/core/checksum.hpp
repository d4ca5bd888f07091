#pragma once

#include <cstdint>
#include <span>

namespace packtrace {

/// The CRC-32 of bytes that follow those of the checksum `before`.
[[nodiscard]] std::uint32_t checksum(std::span<const std::uint8_t> bytes, std::uint32_t before = 0);

}  // namespace packtrace
