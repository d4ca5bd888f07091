#pragma once

#include <span>

#include <packtrace/image_io.hpp>

#include "image/bytes.hpp"

namespace packtrace {

/// A PNG file of 8-bit RGB rows. Throws ImageError, without a file's name, when the picture is
/// too large for the encoder.
[[nodiscard]] Bytes encode_png(const Bytes& rgb, int width, int height);

/// The picture in a PNG file; alpha is dropped, grey spread. Throws ImageError without a name.
[[nodiscard]] Image<float> decode_png(std::span<const std::uint8_t> file);

}  // namespace packtrace
