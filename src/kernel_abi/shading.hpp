#pragma once

#include <cstdint>

// What shading needs to know of objects, materials and lights. Records hold only `Real` fields
// where kernels fetch them by lane, so that a record is an array of its fields.
namespace packtrace::abi {

/// Where the shape of a surface is kept: among the spheres, or among the others. Spheres are
/// among the others where there are few of them, or where they are huge.
using SurfacePlace = std::uint32_t;
inline constexpr SurfacePlace other_shape_bit = 1u << 31;
inline constexpr SurfacePlace finished_bit = 1u << 30;      ///< a sphere's hits are solved again
inline constexpr SurfacePlace faces_viewer_bit = 1u << 29;  ///< as SurfaceRecord has it; spheres
inline constexpr SurfacePlace place_mask = faces_viewer_bit - 1;

constexpr bool is_other_shape(SurfacePlace place)
{
    return (place & other_shape_bit) != 0;
}

/// A sphere to shade by and to solve hits again by, for kernels of both precisions.
struct SphereShape {
    double center[3];
    double radius;
};

/// Outward normal of a plane or sphere at P, before normalising: normal + curvature (P - anchor).
/// A plane has curvature 0; a sphere has its centre as anchor and normal 0.
template <class Real>
struct SurfaceRecord {
    Real anchor[3];
    Real normal[3];
    Real curvature;
    Real faces_viewer;  ///< 1: the normal is turned against the ray; 0: it points outwards
};

/// The same for surfaces of every kind: normal + curvature (P - anchor) with a symmetric matrix
/// for curvature, half the gradient of a quadric.
template <class Real>
struct CurvedSurfaceRecord {
    Real anchor[3];
    Real normal[3];
    Real curvature[6];  ///< xx, yy, zz, xy, xz, yz
    Real faces_viewer;
};

/// I = local (ambient + Σ light (diffuse max(0, N·L) + highlight max(0, R·V)^shininess))
///     + reflect I(reflected) + transmit I(refracted); `local` counts only above the depth limit.
template <class Real>
struct MaterialRecord {
    Real ambient[3];  ///< times the scene's ambient light
    Real diffuse[3];
    Real highlight[3];
    Real reflect[3];
    Real local[3];
    Real transmit[3];
    Real shininess;
    /// Cosines below this give a highlight that is exactly 0.
    Real highlight_floor;
};

/// Where a surface finds its object and material: `first`, or with a checker the one after it on
/// the squares of the other colour.
struct MaterialIndex {
    std::int32_t first;
    std::int32_t checker;  ///< index into the checkers, -1 for none
    std::int32_t object;
};

/// Squares on a plane: the parity of floor(u·P + u_offset) + floor(v·P + v_offset).
template <class Real>
struct CheckerRecord {
    Real point[3];
    Real u[3];  ///< axis / size
    Real v[3];
};

enum class LightKind : std::int32_t { point, directional };

template <class Real>
struct LightRecord {
    Real intensity[3];
    Real vector[3];  ///< position, or direction towards the light
    LightKind kind;
    bool casts_shadow;
};

}  // namespace packtrace::abi
