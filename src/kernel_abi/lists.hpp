#pragma once

#include <cstdint>
#include <type_traits>

// Surfaces are what rays hit: one an object, but three for a capped quadric. They are numbered in
// object order.
//
// Plain views of the lowered scene as the kernels read it. Arrays belong to the host, are
// 64-byte aligned and padded so that reading a whole packet from any valid index is safe.
namespace packtrace::abi {

/// Readable elements behind the last valid one of every array.
inline constexpr int padding = 16;

/// An integer as wide as a real, so that both fill the same lanes.
template <class Real>
using lane_int = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;

/// Spheres |P - center|² = radius², in rising order.
template <class Real>
struct SphereListView {
    const Real* center_x = nullptr;
    const Real* center_y = nullptr;
    const Real* center_z = nullptr;
    const Real* radius = nullptr;
    const Real* radius2 = nullptr;       ///< of the rounded radius
    const Real* center_error = nullptr;  ///< how far rounding moved the centre, at most
    const lane_int<Real>* surface = nullptr;
    int count = 0;
};

/// A sphere whose surface passes near the world's origin for its size, such as a ground: by a point
/// of that surface, so that no term is of the size of the radius:
/// 2 n·p + k p·p + k0 = 0 with p = P - anchor, where n is the outward normal at the anchor,
/// k the curvature 1/r and k0 = (|anchor - center|² - r²) / r makes up for the anchor's rounding.
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

/// A quadric under an affine map. With w = (P - center) - center_low and p = inverse w its
/// equation is s0 x² + s1 y² + s2 z² + 2 linear z + constant = 0, negative inside. Its height in
/// its own space, which clipping goes by, is clip·((P - clip_base) - clip_base_low).
template <class Real>
struct QuadricRecord {
    Real center[3];
    Real center_low[3];  ///< what rounding left of the centre
    Real inverse[3][3];  ///< rows
    Real square[3];
    Real linear;
    Real constant;
    Real counting[3];  ///< 1 for axes that the equation has, else 0
    Real clip[3];
    Real clip_base[3];      ///< where its own space begins: a centre may be far from the clipping
    Real clip_base_low[3];  ///< what rounding left of that
    Real clip_low;          ///< -infinity where nothing is clipped
    Real clip_high;
    Real bound[3];      ///< centre of a ball around the clipped surface
    Real bound_radius;  ///< infinite for an unbounded one
    // What error bounds are made of; R_i is the length of row i of the inverse.
    Real bound_distance;  ///< from the centre to that of the ball
    Real bend_size;       ///< Σ |s_i| R_i²
    Real moment_size;     ///< Σ |s_j s_k| R_j² R_k²
    Real turn_size;       ///< 2 |linear| R_2 (|s_0| R_0² + |s_1| R_1²)
    Real lift_size;       ///< |linear| R_2
    Real clip_size;       ///< |clip|
    std::int32_t clipped;
    std::int32_t capped;
    std::int32_t has_asymptotes;  ///< squares of two signs
    std::int32_t turned;          ///< likewise, along axes that are not the world's
    std::int32_t surface;  ///< its number; with caps the next is the low one's, then the high's
};

template <class Real>
struct PolygonCorner {
    Real position[3];
    std::int32_t starts_contour;
};

/// A planar polygon in world space, by the even-odd rule over its contours. Of each contour the
/// first corner stands once more at its end, so that an edge leads from every corner to the one
/// after it unless that `starts_contour`.
template <class Real>
struct PolygonRecord {
    Real normal[3];  ///< unit, outwards
    Real point[3];   ///< of the plane: the first corner
    Real bound[3];   ///< centre of a ball around the corners, all of them as they are rounded
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
