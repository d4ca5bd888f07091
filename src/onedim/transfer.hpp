#pragma once

#include <array>
#include <cstddef>

#include "onedim/intensity.hpp"

namespace packtrace::onedim {

/// All that the surfaces beyond a segment do to it: the least L of the segment for each R of
/// it. Always monotone.
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

/// The segment before `surface`, given the one beyond it.
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

}  // namespace packtrace::onedim
