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
    /// The height z in the quadric's own space is clip·(P - clip_base).
    Vec3 clip{0.0};
    Vec3 clip_base{0.0};
    double clip_low = -std::numeric_limits<double>::infinity();
    double clip_high = std::numeric_limits<double>::infinity();
    bool capped = false;
    Vec3 bound{0.0};  ///< centre of a ball and of a box around the clipped surface
    double bound_radius = std::numeric_limits<double>::infinity();
    Vec3 box_half{0.0};  ///< half the sizes of the box
    /// An upper bound of the ratio of the longest to the shortest length that world unit vectors
    /// have in canonical space.
    double condition = 1.0;
    std::int32_t surface = 0;  ///< the low and the high cap have the next two numbers

    [[nodiscard]] bool clipped() const
    {
        return clip_low > -std::numeric_limits<double>::infinity() ||
               clip_high < std::numeric_limits<double>::infinity();
    }
};

/// Appends the quadric in world space. Returns the number of surface numbers that it takes. A unit
/// sphere under a similarity becomes a sphere.
int lower_kind(const Object& object, const Quadric& quadric, std::int32_t surface,
               SurfaceLists& lists);

/// The quadric in world space, under its object's transform. It must have passed validate().
[[nodiscard]] LoweredQuadric lower_quadric(const Object& object, const Quadric& quadric,
                                           std::int32_t surface);

/// A sphere as a quadric, for transforms that are not similarities.
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

/// Whether the quadric is bounded, and so well-conditioned that a slightly enlarged box contains
/// its hits in single precision.
[[nodiscard]] bool fits_tree(const LoweredQuadric& quadric);

/// Whether the inside is convex: no square has a negative coefficient.
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
