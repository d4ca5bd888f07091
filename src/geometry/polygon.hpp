#pragma once

#include "core/aligned_array.hpp"
#include "geometry/object_rules.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/shapes.hpp"
#include <packtrace/scene.hpp>

#include <span>
#include <vector>

namespace packtrace {

struct SurfaceLists;

struct LoweredPolygon {
    static constexpr abi::SurfaceKind kind = abi::SurfaceKind::polygon;
    static constexpr auto shapes = &abi::ShapesView::polygons;

    /// Each contour ends with its first corner once more.
    std::vector<abi::PolygonCorner<double>> corners;
    Vec3 normal{0.0, 1.0, 0.0};  ///< unit, outwards
    Vec3 bound{0.0};             ///< centre of a box and of a ball around the corners
    Vec3 box_half{0.0};          ///< half the sizes of the box
    double bound_radius = 0.0;   ///< radius of the ball
    std::int32_t surface = 0;
};

/// Appends the polygon in world space. Returns the number of surface numbers that it takes.
int lower_kind(const Object& object, const Polygon& polygon, std::int32_t surface,
               SurfaceLists& lists);

/// A polygon has no inside.
[[nodiscard]] inline Exit exit_of(const LoweredPolygon&, const Vec3&, const Vec3&)
{
    return std::nullopt;
}

/// All corners, one after another.
[[nodiscard]] std::vector<double> key_of(const LoweredPolygon& polygon);

[[nodiscard]] inline bool is_certifiable(const LoweredPolygon& polygon)
{
    return is_certifiable(polygon.bound, polygon.bound_radius);
}

[[nodiscard]] inline CenteredBox box_of(const LoweredPolygon& polygon)
{
    return {polygon.bound, polygon.box_half};
}

/// Packs a polygon without its corners, which PackedCorners adds.
template <class Real>
[[nodiscard]] abi::PolygonRecord<Real> pack(const LoweredPolygon& polygon);

/// The corners of some polygons, each coordinate rounded once.
template <class Real>
class PackedCorners {
public:
    PackedCorners() = default;

    /// Sets the pointers of `records`, which are the packed `polygons`, to their corners.
    PackedCorners(std::span<const LoweredPolygon* const> polygons,
                  std::span<abi::PolygonRecord<Real>> records);

    [[nodiscard]] std::size_t bytes() const
    {
        return corners_.bytes();
    }

private:
    AlignedArray<abi::PolygonCorner<Real>> corners_;
};

}  // namespace packtrace
