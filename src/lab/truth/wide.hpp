#pragma once

#include "core/quad.hpp"
#include "reference/vec3.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace packtrace::lab {

/// Numbers of 113 bits, in which the truth is computed. The compiler's own type takes a third of
/// the time of Boost's, and rounds the same.
using Wide = Quad;
using WideVec = reference::Vec3<Wide>;

[[nodiscard]] inline WideVec magnitudes(const WideVec& v)
{
    return {magnitude(v.x), magnitude(v.y), magnitude(v.z)};
}

/// The largest magnitude.
[[nodiscard]] inline double largest(const WideVec& v)
{
    const WideVec size = magnitudes(v);
    return static_cast<double>(std::max({size.x, size.y, size.z}));
}

[[nodiscard]] inline WideVec wide(const Vec3& v)
{
    return {Wide(v.x), Wide(v.y), Wide(v.z)};
}

/// The square root, also of numbers outside the range of double; 0 for negative numbers.
[[nodiscard]] inline Wide square_root(const Wide& x)
{
    if (!(x > 0) || x == std::numeric_limits<double>::infinity())
        return x > 0 ? x : 0;
    Wide part = x;
    Wide scale = 1;
    for (; part > 0x1p1000; part *= 0x1p-1000)
        scale *= 0x1p500;
    for (; part < 0x1p-1000; part *= 0x1p1000)
        scale *= 0x1p-500;
    return scale * packtrace::square_root(part);
}

[[nodiscard]] inline double narrow(const Wide& x)
{
    return static_cast<double>(x);
}

[[nodiscard]] inline Vec3 narrow(const WideVec& v)
{
    return {narrow(v.x), narrow(v.y), narrow(v.z)};
}

/// Magnitudes where double is enough.
[[nodiscard]] inline Vec3 sizes(const WideVec& v)
{
    return glm::abs(narrow(v));
}

}  // namespace packtrace::lab
