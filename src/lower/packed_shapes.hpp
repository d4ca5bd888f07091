#pragma once

#include "core/aligned_array.hpp"
#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

/// An array a kind.
template <class... List>
std::tuple<AlignedArray<ShapeOf<KindOf<List>>>...> shape_arrays_of(const std::tuple<List...>&);

/// The shapes that hits are refined and shaded by, in double whatever the precision of the rays, as
/// the kernels find them by surface number. A sphere costs 36 bytes.
class PackedShapes {
public:
    explicit PackedShapes(const LoweredScene& lowered);

    /// Takes over where surfaces are now; each is still of its kind.
    void move(const LoweredScene& lowered);

    /// Valid as long as this object, also where that moves to.
    [[nodiscard]] const abi::ShapesView& view() const
    {
        return view_;
    }

    [[nodiscard]] std::size_t bytes() const
    {
        const auto sum = [](const auto&... shapes) { return (shapes.bytes() + ...); };
        return index_.bytes() + polygon_corners_.bytes() + std::apply(sum, shapes_);
    }

private:
    void pack_corners(const LoweredScene& lowered);

    AlignedArray<abi::SurfaceIndex> index_;
    decltype(shape_arrays_of(surface_lists)) shapes_;
    PackedCorners<double> polygon_corners_;
    abi::ShapesView view_;
};

}  // namespace packtrace
