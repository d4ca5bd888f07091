#pragma once

#include "core/aligned_array.hpp"
#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

/// The shapes that hits are refined and shaded by, in double whatever the precision of the rays, as
/// the kernels find them by surface number. A sphere costs 36 bytes.
class PackedShapes {
public:
    explicit PackedShapes(const LoweredScene& lowered);

    /// Valid as long as this object, also where that moves to.
    [[nodiscard]] const abi::ShapesView& view() const
    {
        return view_;
    }

    [[nodiscard]] std::size_t bytes() const
    {
        return index_.bytes() + spheres_.bytes() + anchored_spheres_.bytes() + planes_.bytes() +
               quadrics_.bytes();
    }

private:
    AlignedArray<abi::SurfaceIndex> index_;
    AlignedArray<abi::SphereShape> spheres_;
    AlignedArray<abi::AnchoredSphere<double>> anchored_spheres_;
    AlignedArray<abi::PlaneRecord<double>> planes_;
    AlignedArray<abi::QuadricRecord<double>> quadrics_;
    abi::ShapesView view_;
};

}  // namespace packtrace
