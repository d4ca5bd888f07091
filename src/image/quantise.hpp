#pragma once

#include <cstdint>
#include <span>

namespace packtrace {

/// Rounds linear values to bytes, into `to`: raised to 1 / gamma, clamped to [0, 1], rounded to
/// the nearest of v / 255; NaN becomes 0. `gamma` is positive.
void quantise(std::span<const float> values, double gamma, std::uint8_t* to);

}  // namespace packtrace
