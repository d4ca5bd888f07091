#pragma once

#include <cstdint>
#include <cstring>
#include <limits>

#include "bvh/bvh.hpp"

// Boxes in registers of four floats, a vector extension of both compilers; the fourth is unused.
namespace packtrace {

using Float4 [[gnu::vector_size(16)]] = float;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

inline Float4 smaller(Float4 a, Float4 b)
{
    return a < b ? a : b;
}
inline Float4 larger(Float4 a, Float4 b)
{
    return a > b ? a : b;
}

struct Box4 {
    static constexpr float inf = std::numeric_limits<float>::infinity();
    Float4 low{inf, inf, inf, inf};
    Float4 high{-inf, -inf, -inf, -inf};

    void include(Float4 other_low, Float4 other_high)
    {
        low = smaller(low, other_low);
        high = larger(high, other_high);
    }
    void include(const Box4& other)
    {
        include(other.low, other.high);
    }
};

inline Float4 load4(const float* from)
{
    Float4 v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

/// A face at NaN bounds nothing: it counts as infinitely far.
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

/// The centre of an item's box, finite whatever the box: halves are added, which cannot overflow.
/// The fourth is 0, as the integers there would make numbers that some processors are slow at.
inline Float4 centroid(const BvhItem& item)
{
    constexpr Int4 first_three{-1, -1, -1, 0};
    const Float4 center = 0.5f * finite(low_of(item)) + 0.5f * finite(high_of(item));
    return reinterpret_cast<Float4>(reinterpret_cast<Int4>(center) & first_three);
}

/// Half the surface of a box: 0 for an empty one, infinite for one without bounds.
inline float half_area(const Box4& box)
{
    if (!(box.low[0] <= box.high[0]))
        return 0.0f;
    const Float4 d = box.high - box.low;
    const float area = d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    return area >= 0.0f ? area : Box4::inf;
}

}  // namespace packtrace
