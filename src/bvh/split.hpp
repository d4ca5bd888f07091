#pragma once

#include <span>
#include <utility>

#include "bvh/box4.hpp"

namespace packtrace {

/// Items that may become a node, a leaf or part of either.
struct BvhRange {
    std::size_t begin = 0;
    std::size_t end = 0;
    Box4 box;
    Box4 centroids;  ///< of the boxes' centres

    [[nodiscard]] std::size_t count() const
    {
        return end - begin;
    }
};

[[nodiscard]] BvhRange range_of(std::span<const BvhItem> items, std::size_t begin, std::size_t end);

/// Sorts the range's items into two ranges where the surface area heuristic is least; by
/// `split_number` when no cut has a finite cost, as where all centres are in one place. `range`
/// has two items at least.
[[nodiscard]] std::pair<BvhRange, BvhRange> split(std::span<BvhItem> items, const BvhRange& range);

/// The same into two halves along the longest axis, to an item.
[[nodiscard]] std::pair<BvhRange, BvhRange> split_number(std::span<BvhItem> items,
                                                         const BvhRange& range);

/// The same by kind; the range has several.
[[nodiscard]] std::pair<BvhRange, BvhRange> split_kinds(std::span<BvhItem> items,
                                                        const BvhRange& range);

}  // namespace packtrace
