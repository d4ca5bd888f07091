#pragma once

#include "bvh/box4.hpp"
#include "kernel_abi/bvh_view.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace packtrace {

/// What a hierarchy is built of: the box of an object, rounded outwards. Any number is safe:
/// faces may be infinite, and one at NaN counts as infinitely far.
struct BvhItem {
    float low[3];
    std::uint32_t number;  ///< the caller's own
    float high[3];
    std::uint32_t kind;  ///< leaves hold objects of one kind only
};

struct BvhLeaf {
    std::uint32_t first;  ///< in `order`
    std::uint32_t count;  ///< 1 … 8
    std::uint32_t kind;
};

/// A hierarchy over numbered objects. Children of `nodes` that are leaves are leaf_bit | index
/// into `leaves`, until whoever packs the objects puts their place instead.
struct Bvh {
    std::vector<abi::BvhNode> nodes;
    std::vector<BvhLeaf> leaves;
    std::vector<std::uint32_t> order;  ///< numbers, leaf after leaf, rising in each
};

/// Builds by the surface area heuristic over 16 bins an axis (Wald, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies", 2007), eight children a node at once, on the threads
/// of the TBB arena the call runs in; the result does not depend on their number. The items
/// are reordered.
[[nodiscard]] Bvh build_bvh(std::span<BvhItem> items);

/// Gives the nodes the boxes of items that have moved; `leaf_boxes` are those of `bvh.leaves`. What
/// stands in which leaf and node stays. Leaves must be named as build_bvh() names them.
void refit_bvh(Bvh& bvh, std::span<const Box4> leaf_boxes);

/// The surface area heuristic of the whole: how many boxes a random line enters that hits the root.
[[nodiscard]] double surface_area_cost(const Bvh& bvh);

}  // namespace packtrace
