#pragma once

#include <packtrace/onedim.hpp>

#include <cstdint>

// A surface as the number its byte holds: bit 0 direction, bits 1-2 reflectance, 3-4
// translucence, 5-6 emission; bit 7 is undefined in memory and 0 in a code.
namespace packtrace::onedim {

static_assert(sizeof(Surface) == 1);

inline constexpr int surface_codes = 128;

constexpr std::uint8_t code_of(const Surface& surface)
{
    return static_cast<std::uint8_t>(static_cast<unsigned>(surface.direction) |
                                     static_cast<unsigned>(surface.reflectance) << 1 |
                                     static_cast<unsigned>(surface.translucence) << 3 |
                                     static_cast<unsigned>(surface.emission) << 5);
}

/// No intensity has the number 3.
constexpr bool is_surface(int code)
{
    return (code >> 1 & 3) != 3 && (code >> 3 & 3) != 3 && (code >> 5 & 3) != 3;
}

constexpr Surface surface_of(int code)
{
    return Surface{static_cast<Direction>(code & 1), static_cast<Intensity>(code >> 1 & 3),
                   static_cast<Intensity>(code >> 3 & 3), static_cast<Intensity>(code >> 5 & 3)};
}

}  // namespace packtrace::onedim
