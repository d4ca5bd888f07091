#pragma once

#include <packtrace/onedim.hpp>

#include <array>
#include <cstddef>

// The note's arithmetic, by its two tables.
namespace packtrace::onedim {

inline constexpr std::array all_intensities{Intensity::none, Intensity::medium, Intensity::all};

namespace detail {

using Table = std::array<std::array<Intensity, 3>, 3>;

inline constexpr Intensity N = Intensity::none;
inline constexpr Intensity M = Intensity::medium;
inline constexpr Intensity A = Intensity::all;

inline constexpr Table sum{{{N, M, A}, {M, A, A}, {A, A, A}}};
inline constexpr Table product{{{N, N, N}, {N, M, M}, {N, M, A}}};

constexpr Intensity look_up(const Table& table, Intensity a, Intensity b)
{
    return table[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
}

}  // namespace detail

constexpr Intensity operator+(Intensity a, Intensity b)
{
    return detail::look_up(detail::sum, a, b);
}

constexpr Intensity operator*(Intensity a, Intensity b)
{
    return detail::look_up(detail::product, a, b);
}

}  // namespace packtrace::onedim
