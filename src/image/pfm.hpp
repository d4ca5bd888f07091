#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <packtrace/image_io.hpp>

#include "image/bytes.hpp"

namespace packtrace {

/// A Portable Float Map: `PF`, size and scale -1 (little endian), then rows from the bottom.
template <class Real>
[[nodiscard]] Bytes encode_pfm(const Image<Real>& image);

/// What stands before the rows.
[[nodiscard]] std::string pfm_header(int width, int height);

/// The bytes of these values, four each, into `to`.
template <class Real>
void encode_pfm_values(std::span<const Real> values, std::uint8_t* to);

/// The picture in a PFM file of either byte order, colour or grey, multiplied by the size of
/// its scale. The raster must fill the file. Throws ImageError without a file's name.
[[nodiscard]] Image<float> decode_pfm(std::span<const std::uint8_t> file);

}  // namespace packtrace
