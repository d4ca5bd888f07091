#pragma once

#include "geometry/object_rules.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/shapes.hpp"
#include <packtrace/scene.hpp>

namespace packtrace {

struct SurfaceLists;

struct LoweredPlane {
    static constexpr abi::SurfaceKind kind = abi::SurfaceKind::plane;
    static constexpr auto shapes = &abi::ShapesView::planes;

    Vec3 point{0.0};
    Vec3 normal{0.0, 1.0, 0.0};  ///< unit
    std::int32_t surface = 0;
};

/// Appends the plane in world space. Returns the number of surface numbers that it takes.
int lower_kind(const Object& object, const Plane& plane, std::int32_t surface, SurfaceLists& lists);

/// The inside of a plane is the half-space that its normal points away from.
[[nodiscard]] Exit exit_of(const LoweredPlane& plane, const Vec3& eye, const Vec3& forward);

[[nodiscard]] inline auto key_of(const LoweredPlane& plane)
{
    return std::tuple_cat(key_of(plane.point), key_of(plane.normal));
}

[[nodiscard]] inline bool is_certifiable(const LoweredPlane& plane)
{
    return is_certifiable(plane.point, 1.0);
}

template <class Real>
[[nodiscard]] abi::PlaneRecord<Real> pack(const LoweredPlane& plane);

}  // namespace packtrace
