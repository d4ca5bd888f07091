#pragma once

#include <cstdint>

// The records of objects, materials and lights that shading reads. Records that kernels load by
// lane hold only `Real` fields, so that a record is an array of its fields.
namespace packtrace::abi {

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
    /// Cosines below this have a highlight that is exactly 0.
    Real highlight_floor;
};

/// The object and material of a surface. The material is `first`; with a checker it is `first + 1`
/// on the squares of the other colour.
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

/// Upper bound of the light that a ray can return.
struct MostLight {
    double channel[3];
};

enum class LightKind : std::int32_t { point, directional };

template <class Real>
struct LightRecord {
    Real intensity[3];
    Real vector[3];  ///< position, or direction towards the light
    LightKind kind;
    bool casts_shadow;
    bool sends_rays;  ///< its shadow rays start at the light; else at the points that it may light
};

}  // namespace packtrace::abi
