#pragma once

#include <span>

#include <packtrace/image_io.hpp>

#include "image/bytes.hpp"
#include "image/png_filter.hpp"

namespace packtrace {

/// The defaults are the best trade of time and size on a rendered picture: see
/// bench/bench_png.cpp and results/png.json.
struct PngSettings {
    double gamma = 1.0;  ///< as in ImageWriteOptions
    PngFilter filter = PngFilter::up;
    int level = 2;  ///< libdeflate's
};

/// An 8-bit RGB PNG file, encoded by the threads of the arena the call runs in; the bytes do
/// not depend on their number. Throws std::invalid_argument for a gamma that is not positive.
[[nodiscard]] Bytes encode_png(const Image<float>& image, const PngSettings& settings = {});

/// The picture in a PNG file; alpha is dropped, grey spread. Throws ImageError without a name.
[[nodiscard]] Image<float> decode_png(std::span<const std::uint8_t> file);

}  // namespace packtrace
