#pragma once

#include <functional>

#include "image/bytes.hpp"

namespace packtrace {

/// Gives row `y` of a picture as 3 bytes a pixel.
using GiveRow = std::function<void(int y, std::uint8_t* row)>;

/// An 8-bit RGB PNG file made by libpng, which holds one row at a time.
[[nodiscard]] Bytes encode_png_rows(int width, int height, const GiveRow& give_row);

}  // namespace packtrace
