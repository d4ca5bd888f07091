#pragma once

#include <vector>

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// The most light that a ray can bring in each channel, by its generation from 0 (camera rays) to
/// max_depth. docs/numerics_derivations.md derives it.
[[nodiscard]] std::vector<Rgb> most_light(const LoweredScene& lowered);

}  // namespace packtrace
