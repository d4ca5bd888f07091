#pragma once

#include <cstdint>
#include <limits>

// Boxes in registers of four floats, by a vector extension of GCC and Clang. The fourth float is
// unused.
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
