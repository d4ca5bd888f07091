#pragma once

#include <vector>

#include <packtrace/camera.hpp>

namespace packtrace {

/// Where in a pixel its samples lie, each coordinate in [0, 1) from the left and top edge: the
/// Hammersley points, one in each of `count` columns and rows. Their mean is the pixel's centre,
/// so that the mean of what changes evenly is exact; one sample is the centre. Coordinates are
/// multiples of 1/4096, so that canvas positions of pictures up to 8192 pixels wide are exact in
/// single precision too. See van der Corput, "Verteilungsfunktionen", 1935, and Hammersley, "Monte
/// Carlo methods for solving multivariable problems", 1960.
[[nodiscard]] std::vector<Vec2> sample_pattern(int count);

}  // namespace packtrace
