#include "core/checksum.hpp"

#include <libdeflate.h>

namespace packtrace {

std::uint32_t checksum(std::span<const std::uint8_t> bytes, std::uint32_t before)
{
    return libdeflate_crc32(before, bytes.data(), bytes.size());
}

}  // namespace packtrace
