#pragma once

#include "geometry/object_rules.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/shapes.hpp"
#include <packtrace/scene.hpp>

#include <limits>

namespace packtrace {

struct SurfaceLists;

/// s0 x² + s1 y² + s2 z² + 2 linear z + constant = 0 at p = inverse (P - center), negative inside.
struct LoweredQuadric {
    static constexpr abi::SurfaceKind kind = abi::SurfaceKind::quadric_side;
    static constexpr auto shapes = &abi::ShapesView::quadrics;

    Vec3 center{0.0};
    Mat3 inverse{1.0};
    Vec3 square{0.0};
    double linear = 0.0;
    double constant = 0.0;
    /// Height in the quadric's own space, which begins at clip_base: clip·(P - clip_base).
    Vec3 clip{0.0};
    Vec3 clip_base{0.0};
    double clip_low = -std::numeric_limits<double>::infinity();
    double clip_high = std::numeric_limits<double>::infinity();
    bool capped = false;
    Vec3 bound{0.0};  ///< centre of a ball around what is left after clipping
    double bound_radius = std::numeric_limits<double>::infinity();
    Vec3 box_half{0.0};  ///< half the sizes of a box around the same centre
    /// How much canonical space is stretched: its longest against its shortest length.
    double condition = 1.0;
    std::int32_t surface = 0;  ///< with caps, the next two numbers are theirs, low and high

    [[nodiscard]] bool clipped() const
    {
        return clip_low > -std::numeric_limits<double>::infinity() ||
               clip_high < std::numeric_limits<double>::infinity();
    }
};

/// Appends the quadric in world space; returns how many surface numbers it takes. A unit sphere
/// under a similarity becomes a sphere.
int lower_kind(const Object& object, const Quadric& quadric, std::int32_t surface,
               SurfaceLists& lists);

/// A quadric in world space under its object's transform; validate() has let it pass.
[[nodiscard]] LoweredQuadric lower_quadric(const Object& object, const Quadric& quadric,
                                           std::int32_t surface);

/// The ellipsoid that a sphere becomes under a transform that is no similarity.
[[nodiscard]] Quadric as_quadric(const Sphere& sphere);

[[nodiscard]] Exit exit_of(const LoweredQuadric& quadric, const Vec3& eye, const Vec3& forward);

[[nodiscard]] inline auto key_of(const LoweredQuadric& quadric)
{
    return std::tuple_cat(key_of(quadric.center), key_of(quadric.inverse[0]),
                          key_of(quadric.inverse[1]), key_of(quadric.inverse[2]),
                          key_of(quadric.square), key_of(quadric.clip), key_of(quadric.clip_base),
                          std::tuple(quadric.linear, quadric.constant, quadric.clip_low,
                                     quadric.clip_high, quadric.capped));
}

[[nodiscard]] bool is_certifiable(const LoweredQuadric& quadric);

[[nodiscard]] inline CenteredBox box_of(const LoweredQuadric& quadric)
{
    return {quadric.bound, quadric.box_half};
}

[[nodiscard]] bool is_bounded(const LoweredQuadric& quadric);

/// Whether the quadric has bounds, and single precision can tell with little room where it is hit.
[[nodiscard]] bool fits_tree(const LoweredQuadric& quadric);

/// Where nothing is bent outwards, what is inside is convex.
[[nodiscard]] inline bool is_convex(const LoweredQuadric& quadric)
{
    return quadric.square.x >= 0.0 && quadric.square.y >= 0.0 && quadric.square.z >= 0.0;
}

[[nodiscard]] inline int pieces_of(const LoweredQuadric& quadric)
{
    return quadric.capped ? 3 : 1;
}

template <class Real>
[[nodiscard]] abi::QuadricRecord<Real> pack(const LoweredQuadric& quadric);

}  // namespace packtrace
