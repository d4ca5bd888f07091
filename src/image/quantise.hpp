#pragma once

#include <packtrace/image.hpp>

#include "image/bytes.hpp"

namespace packtrace {

/// 8-bit samples of a picture, in its order: values raised to 1 / gamma, clamped to [0, 1] and
/// rounded to the nearest of v / 255; NaN becomes 0. Throws std::invalid_argument unless gamma
/// is positive and finite.
[[nodiscard]] Bytes quantise(const Image<float>& image, double gamma);

}  // namespace packtrace
