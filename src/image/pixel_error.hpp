#pragma once

#include <packtrace/image.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>

namespace packtrace {

// Wide enough for the difference of two values of Real, so that it is rounded only once.
template <class Real>
using ErrorReal = std::conditional_t<(sizeof(Real) > sizeof(double)), long double, double>;

/// The absolute difference of two channels. It is infinite if one of them is NaN, or if one is
/// infinite and the other is not the same infinity. So two NaN differ, too.
template <class Real>
[[nodiscard]] ErrorReal<Real> channel_error(Real a, Real b)
{
    if (a == b)
        return 0;
    const ErrorReal<Real> difference =
        static_cast<ErrorReal<Real>>(a) - static_cast<ErrorReal<Real>>(b);
    const ErrorReal<Real> error = difference < 0 ? -difference : difference;
    return error >= 0 ? error : std::numeric_limits<ErrorReal<Real>>::infinity();
}

/// The largest error of a pixel's channels.
template <class Real>
[[nodiscard]] ErrorReal<Real> pixel_error(const Real* a, const Real* b)
{
    return std::max(
        {channel_error(a[0], b[0]), channel_error(a[1], b[1]), channel_error(a[2], b[2])});
}

/// Throws std::invalid_argument if the sizes differ. The message names both.
void check_same_size(int a_width, int a_height, int b_width, int b_height);

}  // namespace packtrace
