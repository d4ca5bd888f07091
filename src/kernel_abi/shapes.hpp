#pragma once

#include "kernel_abi/lists.hpp"

#include <cstdint>

// Surfaces in double, by surface number, whatever the precision of the rays. Points and normals of
// hits are computed from them, and rays that start on a surface are tested against them.
namespace packtrace::abi {

enum class SurfaceKind : std::uint32_t {
    none,  ///< no object of this view: objects that cast no shadow may be omitted
    sphere,
    anchored_sphere,
    plane,
    quadric_side,
    low_cap,
    high_cap,
    polygon
};

/// The index of a surface's record in the array of its kind (for caps: of quadrics).
struct SurfaceIndex {
    std::uint32_t record : 28;
    SurfaceKind kind : 3;
    /// The normal is flipped to face the viewer; else it points outwards.
    std::uint32_t faces_viewer : 1;
};

struct SphereShape {
    double center[3];
    double radius;
};

struct ShapesView {
    const SurfaceIndex* index = nullptr;  ///< by surface number
    const SphereShape* spheres = nullptr;
    const AnchoredSphere<double>* anchored_spheres = nullptr;
    const PlaneRecord<double>* planes = nullptr;
    const QuadricRecord<double>* quadrics = nullptr;
    const PolygonRecord<double>* polygons = nullptr;
    /// Some surface may be hit again by a ray that leaves it on its outer side.
    bool hit_again_outside = false;
};

}  // namespace packtrace::abi
