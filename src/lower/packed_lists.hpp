#pragma once

#include "core/aligned_array.hpp"
#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

/// The objects that no hierarchy holds, list by list, in the arrays and the precision the kernels
/// read.
template <class Real>
class PackedLists {
public:
    /// Of the objects those that are in the hierarchy stay out when there `is_tree`.
    PackedLists(const LoweredScene& lowered, bool is_tree);

    /// Points `view` to the lists, valid as long as this object.
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
    AlignedArray<Real> sphere_reals_;
    AlignedArray<abi::lane_int<Real>> sphere_surfaces_;
    AlignedArray<abi::AnchoredSphere<Real>> anchored_spheres_;
    AlignedArray<abi::PlaneRecord<Real>> planes_;
    AlignedArray<abi::QuadricRecord<Real>> quadrics_;
    AlignedArray<abi::PolygonRecord<Real>> polygons_;
    PackedCorners<Real> polygon_corners_;
};

}  // namespace packtrace
