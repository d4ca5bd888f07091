#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <packtrace/image_io.hpp>

#include "image/bytes.hpp"

namespace packtrace {

struct PngSettings {
    double gamma = 1.0;       ///< as in ImageWriteOptions
    std::string recipe = {};  ///< as in ImageWriteOptions
    /// Bytes of samples: more of them are compressed row by row, in little memory, into a larger
    /// file.
    std::size_t largest_whole = std::size_t{1} << 27;
};

/// An 8-bit RGB PNG file. Throws std::invalid_argument for a gamma that is not positive.
template <class Real>
[[nodiscard]] Bytes encode_png(const Image<Real>& image, const PngSettings& settings = {});

/// The file of samples that are rounded already, 3 bytes a pixel, compressed as a whole.
[[nodiscard]] Bytes encode_png_samples(const Bytes& samples, int width, int height);

/// The recipe in the first bytes of a PNG file, as many as there are at hand; empty for none.
[[nodiscard]] std::string png_recipe(std::span<const std::uint8_t> file);

/// The picture in a PNG file; alpha is dropped, grey spread. Throws ImageError without a name.
[[nodiscard]] Image<float> decode_png(std::span<const std::uint8_t> file);

}  // namespace packtrace
