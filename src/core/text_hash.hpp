#pragma once

#include <cstdint>
#include <string_view>

namespace packtrace {

/// FNV-1a (Fowler, Noll and Vo) in 64 bits: the same on every machine and in every version.
[[nodiscard]] constexpr std::uint64_t text_hash(std::string_view text)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char letter : text)
        hash = (hash ^ static_cast<std::uint8_t>(letter)) * 0x100000001b3u;
    return hash;
}

}  // namespace packtrace
