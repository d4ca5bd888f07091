#pragma once

#include <span>
#include <string>

#include <packtrace/image_io.hpp>

#include "image/bytes.hpp"

namespace packtrace {

/// A Radiance RGBE file. Negative values and NaN become 0, values from 2^127 up the largest
/// below it: the format has no others.
[[nodiscard]] Bytes encode_hdr(const Image<float>& image);

/// What stands before the rows.
[[nodiscard]] std::string hdr_header(int width, int height);

/// Appends a row of red, green and blue to the file.
void append_hdr_row(Bytes& file, std::span<const float> row);

/// The picture in a Radiance file. Throws ImageError without a file's name.
[[nodiscard]] Image<float> decode_hdr(std::span<const std::uint8_t> file);

}  // namespace packtrace
