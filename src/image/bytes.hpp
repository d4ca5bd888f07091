#pragma once

#include <cstdint>
#include <vector>

namespace packtrace {

/// An encoded picture file, or rows of 8-bit samples.
using Bytes = std::vector<std::uint8_t>;

}  // namespace packtrace
