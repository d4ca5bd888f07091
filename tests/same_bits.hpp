#pragma once

#include <packtrace/image.hpp>
#include <packtrace/rays.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <ranges>
#include <type_traits>

// Bitwise comparisons: a NaN equals a NaN with the same bits, and -0 differs from 0.
namespace packtrace::test {

template <class Number>
requires std::is_arithmetic_v<Number>
[[nodiscard]] bool same_bits(Number a, Number b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Compares each field: the padding of a hit may hold anything.
template <class Real>
[[nodiscard]] bool same_bits(const SurfaceHit<Real>& a, const SurfaceHit<Real>& b)
{
    return same_bits(a.t, b.t) && a.object == b.object &&
           std::memcmp(a.normal, b.normal, sizeof a.normal) == 0;
}

[[nodiscard]] inline bool same_bits(const HitBounds& a, const HitBounds& b)
{
    return same_bits(a.low, b.low) && same_bits(a.high, b.high);
}

/// Lists of different lengths differ.
template <std::ranges::sized_range List, std::ranges::sized_range OtherList>
[[nodiscard]] bool same_bits(const List& a, const OtherList& b)
{
    return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return same_bits(x, y); });
}

/// Pictures of different sizes differ.
template <class Real>
[[nodiscard]] bool same_bits(const Image<Real>& a, const Image<Real>& b)
{
    return a.width == b.width && a.height == b.height && same_bits(a.rgb, b.rgb);
}

/// The number of elements of two lists that differ in any bit. Elements beyond the shorter list
/// count as different.
template <class List>
[[nodiscard]] std::size_t different_bits(const List& a, const List& b)
{
    const auto [shorter, longer] = std::minmax({a.size(), b.size()});
    std::size_t count = longer - shorter;
    for (std::size_t i = 0; i < shorter; ++i)
        count += same_bits(a[i], b[i]) ? 0u : 1u;
    return count;
}

}  // namespace packtrace::test
