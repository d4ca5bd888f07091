#pragma once

#include <span>

#include "bvh/box4.hpp"
#include "bvh/bvh.hpp"

namespace packtrace {

/// Gives the nodes the boxes of items that have moved; `leaf_boxes` are those of `bvh.leaves`. What
/// stands in which leaf and node stays. Leaves must be named as build_bvh() names them.
void refit_bvh(Bvh& bvh, std::span<const Box4> leaf_boxes);

/// The surface area heuristic of the whole: how many boxes a random line enters that hits the root.
[[nodiscard]] double surface_area_cost(const Bvh& bvh);

}  // namespace packtrace
