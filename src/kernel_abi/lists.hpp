#pragma once

#include <cstdint>
#include <type_traits>

// Surfaces are what rays hit: one per object, but three for a capped quadric. They are numbered in
// object order.
//
// Plain views of the lowered scene as the kernels read it. The host owns the arrays. They are
// 64-byte aligned, and padded so that a whole packet can be read from any valid index.
namespace packtrace::abi {

/// Readable elements after the last valid element of every array.
inline constexpr int padding = 16;

/// An integer as wide as a real, so that packets of both have the same lanes.
template <class Real>
using lane_int = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;

/// Spheres |P - center|² = radius², in order of their surface numbers.
template <class Real>
struct SphereListView {
    const Real* center_x = nullptr;
    const Real* center_y = nullptr;
    const Real* center_z = nullptr;
    const Real* radius = nullptr;
    const Real* radius2 = nullptr;       ///< square of the rounded radius
    const Real* center_error = nullptr;  ///< upper bound of how far rounding moved the centre
    const lane_int<Real>* surface = nullptr;
    int count = 0;
};

/// A sphere whose surface passes close to the world's origin compared with its radius, such as a
/// ground. It is given by a point of its surface, the anchor, so that no term is as large as the
/// radius: 2 n·p + k p·p + k0 = 0 with p = P - anchor. n is the outward normal at the anchor, k the
/// curvature 1/r, and k0 = (|anchor - center|² - r²) / r corrects for the rounding of the anchor.
template <class Real>
struct AnchoredSphere {
    Real anchor[3];
    Real normal[3];
    Real curvature;
    Real offset;  ///< k0
    Real center[3];
    Real radius;
    std::int32_t surface;
};

/// normal·(P - point) = 0.
template <class Real>
struct PlaneRecord {
    Real point[3];
    Real normal[3];
    std::int32_t surface;
};

/// A quadric under an affine map. With w = (P - center) - center_low and p = inverse w, its
/// equation is s0 x² + s1 y² + s2 z² + 2 linear z + constant = 0; the left side is negative inside.
/// Clipping compares the height clip·((P - clip_base) - clip_base_low) with clip_low and clip_high.
template <class Real>
struct QuadricRecord {
    Real center[3];
    Real center_low[3];  ///< rounding error of the centre
    Real inverse[3][3];  ///< rows
    Real square[3];
    Real linear;
    Real constant;
    Real counting[3];  ///< 1 for axes that occur in the equation, else 0
    Real clip[3];
    Real clip_base[3];      ///< origin of the quadric's own space; the centre may be far from the
                            ///< clipping planes
    Real clip_base_low[3];  ///< rounding error of clip_base
    Real clip_low;          ///< -infinity if not clipped below
    Real clip_high;
    Real bound[3];      ///< centre of a ball around the clipped surface
    Real bound_radius;  ///< infinite if unbounded
    // Terms of the error bounds; R_i is the length of row i of the inverse.
    Real bound_distance;  ///< from the quadric's centre to the centre of the ball
    Real bend_size;       ///< Σ |s_i| R_i²
    Real moment_size;     ///< Σ |s_j s_k| R_j² R_k²
    Real turn_size;       ///< 2 |linear| R_2 (|s_0| R_0² + |s_1| R_1²)
    Real lift_size;       ///< |linear| R_2
    Real clip_size;       ///< |clip|
    std::int32_t clipped;
    std::int32_t capped;
    std::int32_t has_asymptotes;  ///< squares have both signs
    std::int32_t turned;          ///< squares have both signs, along axes other than the world's
    std::int32_t surface;  ///< number of the side; with caps, the next two numbers are the low and
                           ///< the high cap
};

template <class Real>
struct PolygonCorner {
    Real position[3];
    std::int32_t starts_contour;
};

/// A planar polygon in world space, filled by the even-odd rule over its contours. The first corner
/// of each contour is repeated at its end, so every corner but the last of a contour starts an edge
/// to the next one.
template <class Real>
struct PolygonRecord {
    Real normal[3];  ///< unit, outwards
    Real point[3];   ///< a point of the plane: the first corner
    Real bound[3];   ///< centre of a ball around all rounded corners
    Real bound_radius;
    const PolygonCorner<Real>* corners;
    std::int32_t corner_count;
    std::int32_t surface;
};

template <class Record>
struct RecordList {
    const Record* data = nullptr;
    int count = 0;
};

}  // namespace packtrace::abi
