#pragma once

#include <packtrace/render.hpp>

#include <algorithm>

namespace packtrace {

/// Adds the rays of parts of a picture, or of several pictures. The largest bound holds for all.
inline CutRays& operator+=(CutRays& sum, const CutRays& more)
{
    sum.rays += more.rays;
    sum.bound = std::max(sum.bound, more.bound);
    return sum;
}

/// The smallest weight of a ray that is traced, for a value of Scene::min_weight. Weights are
/// products of up to 64 rounded factors, with an error of up to 2⁻¹⁷ in single precision. The
/// margin makes sure that a weight equal to min_weight, as written in decimals, is traced in every
/// precision.
constexpr double least_traced_weight(double min_weight)
{
    return min_weight * (1.0 - 0x1p-16);
}

}  // namespace packtrace
