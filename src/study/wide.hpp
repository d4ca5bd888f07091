#pragma once

#include <algorithm>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "reference/vec3.hpp"

namespace packtrace::study {

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

}  // namespace packtrace::study
