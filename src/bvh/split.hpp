#pragma once

#include "bvh/box4.hpp"
#include "bvh/bvh.hpp"

#include <cstddef>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

// Ranges of items, and how they are split.
namespace packtrace {

inline Float4 load4(const float* from)
{
    Float4 v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

/// A face at NaN counts as infinitely far away.
inline Float4 low_of(const BvhItem& item)
{
    const Float4 low = load4(item.low);
    return low == low ? low : Float4{-Box4::inf, -Box4::inf, -Box4::inf, -Box4::inf};
}
inline Float4 high_of(const BvhItem& item)
{
    const Float4 high = load4(item.high);
    return high == high ? high : Float4{Box4::inf, Box4::inf, Box4::inf, Box4::inf};
}

/// The nearest finite number.
inline Float4 finite(Float4 a)
{
    constexpr float largest = std::numeric_limits<float>::max();
    constexpr Float4 most{largest, largest, largest, largest};
    return larger(smaller(a, most), -most);
}

/// The centre of an item's box, finite for every box: halves are added, which cannot overflow. The
/// fourth component is 0, because the integers there would be subnormal floats, which are slow on
/// some processors.
inline Float4 centroid(const BvhItem& item)
{
    constexpr Int4 first_three{-1, -1, -1, 0};
    const Float4 center = 0.5f * finite(low_of(item)) + 0.5f * finite(high_of(item));
    return reinterpret_cast<Float4>(reinterpret_cast<Int4>(center) & first_three);
}

/// A range of items, which may become a node, a leaf or part of either.
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

/// Sorts a range's items into two ranges by the cut of least cost by the surface area heuristic; by
/// split_number() if no cut has a finite cost, as when all centres are equal. `range` has at least
/// two items.
[[nodiscard]] std::pair<BvhRange, BvhRange> split(std::span<BvhItem> items, const BvhRange& range);

/// Sorts them into two ranges of equal number, or one more, along the axis on which the centres are
/// furthest apart.
[[nodiscard]] std::pair<BvhRange, BvhRange> split_number(std::span<BvhItem> items,
                                                         const BvhRange& range);

/// Sorts them into the items of one kind and the others; the range has several kinds.
[[nodiscard]] std::pair<BvhRange, BvhRange> split_kinds(std::span<BvhItem> items,
                                                        const BvhRange& range);

}  // namespace packtrace
