#pragma once

#include <string_view>
#include <system_error>

namespace packtrace::cli {

/// A number of a CSV field in the precision of Real. `error` is std::errc{} for a number,
/// infinities and NaN among them; invalid_argument for anything else; result_out_of_range for
/// one too large. One too small becomes zero, but below the range of long double an error too.
template <class Real>
struct RayNumber {
    Real value = 0;
    std::errc error{};
};

template <class Real>
[[nodiscard]] RayNumber<Real> to_ray_number(std::string_view field);

}  // namespace packtrace::cli
