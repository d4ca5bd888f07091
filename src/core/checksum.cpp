#include "core/checksum.hpp"

#include <libdeflate.h>

#include <cstdio>

namespace packtrace {

std::uint32_t checksum(std::span<const std::uint8_t> bytes, std::uint32_t before)
{
    return libdeflate_crc32(before, bytes.data(), bytes.size());
}

std::string text_hash_digits(std::string_view text)
{
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx",
                  static_cast<unsigned long long>(text_hash(text)));
    return digits;
}

}  // namespace packtrace
