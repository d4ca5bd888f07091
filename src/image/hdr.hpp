#pragma once

#include <span>

#include <packtrace/image_io.hpp>

#include "image/bytes.hpp"

namespace packtrace {

/// A Radiance RGBE file. Negative values and NaN become 0, values from 2^127 up the largest
/// below it: the format has no others.
[[nodiscard]] Bytes encode_hdr(const Image<float>& image);

/// The picture in a Radiance file. Throws ImageError without a file's name.
[[nodiscard]] Image<float> decode_hdr(std::span<const std::uint8_t> file);

}  // namespace packtrace
