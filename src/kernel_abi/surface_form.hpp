#pragma once

#include <cstdint>

// Surfaces as equations in the world, in double whatever the precision of the rays: what hits on
// them are sharpened with, and what rays that start on them are held against.
namespace packtrace::abi {

/// From where a ray that starts on a surface may meet that surface again.
enum class MetAgain : std::int32_t {
    never,        ///< flat
    from_inside,  ///< convex
    from_anywhere
};

/// What one more step in double makes exact of a hit of rays in single precision: its point, where
/// rays start; or its t as well.
enum class Sharpened : std::int32_t { nothing, point, all };

/// constant + 2 normal·p + p·curvature p = 0 with p = P - anchor, negative inside; scaled so
/// that the largest coefficient of p is about 1.
struct SurfaceForm {
    double anchor[3];
    double normal[3];
    double curvature[6];  ///< xx, yy, zz, xy, xz, yz
    double constant;
    // Only points with clip·p + clip_offset from clip_low to clip_high are of the surface.
    double clip[3];
    double clip_offset;
    double clip_low;  ///< -infinity where nothing is clipped
    double clip_high;
    MetAgain met_again;
    Sharpened sharpened;
};

}  // namespace packtrace::abi
