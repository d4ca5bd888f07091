#pragma once

#include <packtrace/render.hpp>

#include <algorithm>

namespace packtrace {

/// Of several parts of a picture, or of several pictures: the largest bound.
inline CutRays& operator+=(CutRays& sum, const CutRays& more)
{
    sum.rays += more.rays;
    sum.bound = std::max(sum.bound, more.bound);
    return sum;
}

/// The least weight of a ray that is traced where Scene::min_weight is this. Weights are products
/// of up to 64 factors, each rounded: in single precision they are off by up to 2⁻¹⁷. One that
/// equals min_weight as written in decimals is traced in every precision.
constexpr double least_traced_weight(double min_weight)
{
    return min_weight * (1.0 - 0x1p-16);
}

}  // namespace packtrace
