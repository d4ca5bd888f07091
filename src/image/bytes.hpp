#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace packtrace {

/// An encoded picture file, or rows of 8-bit samples.
using Bytes = std::vector<std::uint8_t>;

/// Rounds linear values (float, double or long double) to bytes, into `to`. Values are raised to
/// 1 / gamma, clamped to [0, 1], and rounded to the nearest v / 255; NaN becomes 0. `gamma` must be
/// positive.
template <class Real>
void quantise(std::span<const Real> values, double gamma, std::uint8_t* to);

}  // namespace packtrace
