#pragma once

#include <cmath>
#include <limits>

// Floating point with 113 bits, in software, from the compiler.
namespace packtrace {

// long double has 113 bits on 64-bit Arm, but not on x86-64.
#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Quad;
#else
using Quad = long double;
static_assert(__LDBL_MANT_DIG__ == 113);
#endif

[[nodiscard]] inline Quad magnitude(Quad x)
{
    return x < 0 ? -x : x;
}

/// The square root of a number in double's range, within a few units in the last place. 0 if the
/// number is not above 0.
[[nodiscard]] inline Quad square_root(Quad x)
{
    const double start = std::sqrt(static_cast<double>(x));
    if (!(x > 0) || !(start > 0.0) || !(start < std::numeric_limits<double>::infinity()))
        return 0;
    Quad root = start;
    for (int step = 0; step < 2; ++step)
        root = (root + x / root) / 2;
    return root;
}

/// The largest double that is at most x.
[[nodiscard]] inline double round_down(Quad x)
{
    const double near = static_cast<double>(x);
    return near > x ? std::nextafter(near, -std::numeric_limits<double>::infinity()) : near;
}

/// The smallest double that is at least x.
[[nodiscard]] inline double round_up(Quad x)
{
    const double near = static_cast<double>(x);
    return near < x ? std::nextafter(near, std::numeric_limits<double>::infinity()) : near;
}

}  // namespace packtrace
