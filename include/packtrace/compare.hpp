#pragma once

#include <packtrace/export.hpp>
#include <packtrace/image.hpp>

#include <cstddef>
#include <vector>

namespace packtrace {

/// How far a pixel of one picture is from the same pixel of another.
struct PixelError {
    int x = 0;           ///< column, from the left
    int y = 0;           ///< row, from the top
    double error = 0.0;  ///< largest absolute difference of a channel; infinite for NaN
};

struct CompareOptions {
    double threshold = 1.0 / 255.0;  ///< a pixel with a larger error counts as off
    int worst = 5;                   ///< how many of the worst pixels to list
};

/// The distance between two pictures of equal size, in the pictures' linear values.
struct Comparison {
    double max_abs = 0.0;
    double rmse = 0.0;  ///< over all channels of all pixels
    double psnr = 0.0;  ///< decibels for a peak of 1; infinite for equal pictures
    std::size_t pixels = 0;
    std::size_t pixels_off = 0;     ///< pixels whose error exceeds the threshold
    std::vector<PixelError> worst;  ///< largest error first, then reading order; none when equal
};

/// Compares two pictures. Throws std::invalid_argument that names both sizes when unequal, and for
/// negative options.
template <class Real>
[[nodiscard]] PACKTRACE_API Comparison compare(const Image<Real>& a, const Image<Real>& b,
                                               const CompareOptions& options = {});

/// A picture of the error per pixel: black for none, through blue, green, yellow, red to white
/// at the scale of the largest error (logarithmic over six decades below it).
template <class Real>
[[nodiscard]] PACKTRACE_API Image<float> heatmap(const Image<Real>& a, const Image<Real>& b);

}  // namespace packtrace
