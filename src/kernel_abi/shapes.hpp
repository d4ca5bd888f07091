#pragma once

#include "kernel_abi/lists.hpp"

#include <cstdint>

// Surfaces in double, found by surface number, whatever the precision of the rays: what a hit's
// point and normal come from, and what a ray that starts on a surface is held against.
namespace packtrace::abi {

enum class SurfaceKind : std::uint32_t {
    none,  ///< no object of this view, as where those that cast no shadow are left out
    sphere,
    anchored_sphere,
    plane,
    quadric_side,
    low_cap,
    high_cap,
    polygon
};

/// Where the record of a surface is: in the array of its kind (caps: of quadrics).
struct SurfaceIndex {
    std::uint32_t record : 28;
    SurfaceKind kind : 3;
    std::uint32_t faces_viewer : 1;  ///< the normal is turned against the ray, else outwards
};

struct SphereShape {
    double center[3];
    double radius;
};

struct ShapesView {
    const SurfaceIndex* index = nullptr;  ///< by surface
    const SphereShape* spheres = nullptr;
    const AnchoredSphere<double>* anchored_spheres = nullptr;
    const PlaneRecord<double>* planes = nullptr;
    const QuadricRecord<double>* quadrics = nullptr;
    const PolygonRecord<double>* polygons = nullptr;
    /// Some surface may be hit again by rays that leave it on its outer side.
    bool hit_again_outside = false;
};

}  // namespace packtrace::abi
