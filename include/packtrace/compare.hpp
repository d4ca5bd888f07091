#pragma once

#include <packtrace/export.hpp>
#include <packtrace/image.hpp>

#include <cstddef>
#include <vector>

namespace packtrace {

/// The difference between a pixel of one picture and the same pixel of another.
struct PixelError {
    int x = 0;           ///< column, from the left, from 0
    int y = 0;           ///< row, from the top, from 0
    double error = 0.0;  ///< largest absolute difference of a channel; infinite for NaN
};

struct CompareOptions {
    double threshold = 1.0 / 255.0;  ///< a pixel with a larger error counts as off
    int worst = 5;                   ///< how many of the worst pixels to list
};

/// The difference between two pictures of equal size, in linear values.
struct Comparison {
    double max_abs = 0.0;
    double rmse = 0.0;  ///< over all channels of all pixels
    double psnr = 0.0;  ///< decibels, for a peak of 1; infinite for equal pictures
    std::size_t pixels = 0;
    std::size_t pixels_off = 0;     ///< pixels whose error exceeds the threshold
    std::vector<PixelError> worst;  ///< largest error first, then reading order; none if equal
};

/// Compares two pictures. Throws std::invalid_argument for pictures of different sizes (the message
/// names both) and for negative options.
template <class Real>
[[nodiscard]] PACKTRACE_API Comparison compare(const Image<Real>& a, const Image<Real>& b,
                                               const CompareOptions& options = {});

/// A picture of the error per pixel, from black for no error through blue, green, yellow and red to
/// white for the largest error. The scale is logarithmic, over the six decades below the largest
/// error.
template <class Real>
[[nodiscard]] PACKTRACE_API Image<float> heatmap(const Image<Real>& a, const Image<Real>& b);

}  // namespace packtrace
