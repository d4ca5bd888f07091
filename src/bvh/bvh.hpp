#pragma once

#include "bvh/box4.hpp"
#include "kernel_abi/bvh_view.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace packtrace {

/// An object to build a BVH over: its box, rounded outwards. Any number is safe: faces may be
/// infinite, and a face at NaN counts as infinitely far away.
struct BvhItem {
    float low[3];
    std::uint32_t number;  ///< of the object; given by the caller
    float high[3];
    std::uint32_t kind;  ///< each leaf holds objects of one kind
};

struct BvhLeaf {
    std::uint32_t first;  ///< in `order`
    std::uint32_t count;  ///< 1 … 8
    std::uint32_t kind;
};

/// A bounding volume hierarchy over numbered objects. A child of a node that is a leaf is
/// leaf_bit | its index in `leaves`. PackedTree replaces it in its copy of the nodes.
struct Bvh {
    std::vector<abi::BvhNode> nodes;
    std::vector<BvhLeaf> leaves;
    std::vector<std::uint32_t> order;  ///< objects' numbers, leaf after leaf, rising in each leaf
};

/// Builds by the surface area heuristic over 16 bins on each axis (Wald, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies", 2007), with up to eight children in each node. Runs on
/// the threads of the TBB arena of the caller; the result does not depend on their number. Reorders
/// the items.
[[nodiscard]] Bvh build_bvh(std::span<BvhItem> items);

/// Updates the nodes' boxes after objects have moved; `leaf_boxes` are those of `bvh.leaves`. The
/// nodes and leaves keep their members.
void refit_bvh(Bvh& bvh, std::span<const Box4> leaf_boxes);

/// The surface area heuristic of the BVH: how many boxes a random line enters that hits the root.
[[nodiscard]] double surface_area_cost(const Bvh& bvh);

}  // namespace packtrace
