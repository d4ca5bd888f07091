#pragma once

#include "core/aligned_array.hpp"
#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Which objects of a scene are in its lists.
enum class Listed { all, outside_bvh };

/// Lists of objects by kind, as arrays in the precision that the kernels read.
template <class Real>
class PackedLists {
public:
    PackedLists(const LoweredScene& lowered, Listed which);

    /// Points `view` to the lists; valid as long as this object.
    void show(abi::GeometryView<Real>& view) const;

    [[nodiscard]] std::size_t bytes() const
    {
        return sphere_reals_.bytes() + sphere_surfaces_.bytes() + anchored_spheres_.bytes() +
               planes_.bytes() + quadrics_.bytes() + polygons_.bytes() + polygon_corners_.bytes();
    }

private:
    void pack_spheres(const std::vector<const LoweredSphere*>& spheres);

    int sphere_count_ = 0;
    std::size_t sphere_stride_ = 0;
    AlignedArray<Real> sphere_reals_;  // see pack_spheres()
    AlignedArray<abi::lane_int<Real>> sphere_surfaces_;
    AlignedArray<abi::AnchoredSphere<Real>> anchored_spheres_;
    AlignedArray<abi::PlaneRecord<Real>> planes_;
    AlignedArray<abi::QuadricRecord<Real>> quadrics_;
    AlignedArray<abi::PolygonRecord<Real>> polygons_;
    PackedCorners<Real> polygon_corners_;
};

}  // namespace packtrace
