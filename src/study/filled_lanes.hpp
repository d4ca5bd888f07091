#pragma once

#include <optional>
#include <vector>

#include <packtrace/scene.hpp>

#include "kernel_abi/kernel_table.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

/// By generation, the share of lanes with a ray in the packets that a tile's rays are cut into, 0
/// for a generation without rays. Counted from tiles' rays, of one sample a pixel, as frames end
/// one generation later each. None for glass, whose streams are cut in a way that tiles do not
/// tell.
template <class Real>
[[nodiscard]] std::optional<std::vector<double>> filled_lanes(const Scene& scene,
                                                              const LoweredScene& lowered,
                                                              const abi::KernelTable& table);

}  // namespace packtrace
