#pragma once

#include <algorithm>
#include <cmath>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <glm/common.hpp>

#include "reference/vec3.hpp"

namespace packtrace::lab {

/// 113 bits: what the results of kernels are held against.
using Wide = boost::multiprecision::cpp_bin_float_quad;
using WideVec = reference::Vec3<Wide>;

[[nodiscard]] inline WideVec magnitudes(const WideVec& v)
{
    using boost::multiprecision::abs;
    return {abs(v.x), abs(v.y), abs(v.z)};
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

/// The square root, 0 of what is below 0. Two steps of Newton's method from double's root take a
/// fifth of the time of the library's own, which goes bit by bit.
[[nodiscard]] inline Wide square_root(const Wide& x)
{
    if (!(x > 0))
        return 0;
    int exponent = 0;
    Wide part = frexp(x, &exponent);
    if (exponent % 2 != 0) {
        part *= 2;
        --exponent;
    }
    Wide root = std::sqrt(static_cast<double>(part));
    for (int step = 0; step < 2; ++step)
        root = (root + part / root) / 2;
    return ldexp(root, exponent / 2);
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
