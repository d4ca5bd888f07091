#pragma once

#include "onedim/intensity.hpp"
#include <packtrace/onedim.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

// Transfer functions, the step by which a surface turns one into the next, and surfaces as numbers
// to look such steps up by.
namespace packtrace::onedim {

/// What the surfaces beyond a segment return to it: the least L of the segment for each R. Always
/// monotone.
struct Transfer {
    std::array<Intensity, 3> left_for{};  ///< by R; all None behind the last surface

    constexpr Intensity operator()(Intensity right) const
    {
        return left_for[static_cast<std::size_t>(right)];
    }
    bool operator==(const Transfer&) const = default;
};

/// The least y with y = f(y), for monotone f: three values can rise only twice.
template <class Function>
constexpr Intensity least_fixpoint(const Function& f)
{
    return f(f(Intensity::none));
}

/// The transfer function of the segment before `surface`, given that of the segment beyond.
constexpr Transfer step(const Surface& surface, const Transfer& beyond)
{
    Transfer before;
    for (const Intensity x : all_intensities) {
        Intensity& left = before.left_for[static_cast<std::size_t>(x)];
        if (surface.direction == Direction::towards) {
            left = surface.reflectance * x + surface.translucence * beyond(x) + surface.emission;
            continue;
        }
        const Intensity right = least_fixpoint([&](Intensity y) {
            return surface.reflectance * beyond(y) + surface.translucence * x + surface.emission;
        });
        left = beyond(right);
    }
    return before;
}

// A surface's code is the value of its byte: bit 0 direction, bits 1-2 reflectance, 3-4
// translucence, 5-6 emission. Bit 7 is undefined in memory and 0 in a code.

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
