#pragma once

#include <cstdint>
#include <span>

namespace packtrace {

/// PNG's row filters in use here, by their numbers in the file.
enum class PngFilter : std::uint8_t {
    none = 0,
    sub = 1,  ///< difference from the pixel to the left
    up = 2    ///< difference from the pixel above
};

/// Filters a row of 3-byte pixels into `out`, of the same length. `above` is the row over it,
/// zeros for the first one; only `up` looks at it.
void filter_row(PngFilter filter, std::span<const std::uint8_t> row, const std::uint8_t* above,
                std::uint8_t* out);

}  // namespace packtrace
