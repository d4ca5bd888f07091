#pragma once

#include <span>
#include <string>

#include <packtrace/image_io.hpp>

#include "image/bytes.hpp"
#include "image/png_filter.hpp"

namespace packtrace {

/// The defaults are the best trade of time and size on a rendered picture: see
/// bench/bench_png.cpp and results/png.json.
struct PngSettings {
    double gamma = 1.0;  ///< as in ImageWriteOptions
    PngFilter filter = PngFilter::up;
    int level = 2;            ///< libdeflate's
    std::string recipe = {};  ///< as in ImageWriteOptions
};

/// An 8-bit RGB PNG file, encoded by the threads of the arena the call runs in; the bytes do
/// not depend on their number. Throws std::invalid_argument for a gamma that is not positive.
template <class Real>
[[nodiscard]] Bytes encode_png(const Image<Real>& image, const PngSettings& settings = {});

/// The recipe in the first bytes of a PNG file, as many as there are at hand; empty for none.
[[nodiscard]] std::string png_recipe(std::span<const std::uint8_t> file);

/// The picture in a PNG file; alpha is dropped, grey spread. Throws ImageError without a name.
[[nodiscard]] Image<float> decode_png(std::span<const std::uint8_t> file);

}  // namespace packtrace
