#pragma once

#include <algorithm>

#include <packtrace/render.hpp>

namespace packtrace {

/// Of several parts of a picture, or of several pictures: the largest bound.
inline CutRays& operator+=(CutRays& sum, const CutRays& more)
{
    sum.rays += more.rays;
    sum.bound = std::max(sum.bound, more.bound);
    return sum;
}

}  // namespace packtrace
