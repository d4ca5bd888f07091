#pragma once

#include <packtrace/camera.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace packtrace {

/// The positions of samples in a pixel, measured from its left and top edges, each coordinate in
/// [0, 1). They are the Hammersley points: one in each of `count` columns and rows. Their mean is
/// the pixel's centre, so the mean of a linear function is exact. A single sample is the centre.
/// Coordinates are multiples of 1/4096, so canvas positions in pictures up to 8192 pixels wide are
/// exact in single precision, too. See van der Corput, "Verteilungsfunktionen", 1935, and
/// Hammersley, "Monte Carlo methods for solving multivariable problems", 1960.
[[nodiscard]] inline std::vector<Vec2> sample_pattern(int count)
{
    // Mirrors the bits of a number at the binary point.
    const auto radical_inverse = [](int number) {
        double inverse = 0.0;
        for (double digit = 0.5; number != 0; number >>= 1, digit *= 0.5)
            inverse += (number & 1) * digit;
        return inverse;
    };
    const auto on_grid = [](double x) {
        constexpr double steps = 4096.0;
        return std::floor(x * steps + 0.5) / steps;
    };
    // Ranks the radical inverses, so that each row gets one sample for any count.
    std::vector<int> by_row(static_cast<std::size_t>(count));
    std::iota(by_row.begin(), by_row.end(), 0);
    std::sort(by_row.begin(), by_row.end(),
              [&](int a, int b) { return radical_inverse(a) < radical_inverse(b); });
    std::vector<Vec2> pattern(by_row.size());
    for (int row = 0; row < count; ++row) {
        const int column = by_row[static_cast<std::size_t>(row)];
        pattern[static_cast<std::size_t>(column)] = {on_grid((column + 0.5) / count),
                                                     on_grid((row + 0.5) / count)};
    }
    return pattern;
}

}  // namespace packtrace
