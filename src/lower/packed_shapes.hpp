#pragma once

#include "core/aligned_array.hpp"
#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

/// The type of one array for each kind.
template <class... List>
std::tuple<AlignedArray<ShapeOf<KindOf<List>>>...> shape_arrays_of(const std::tuple<List...>&);

/// The shapes of all surfaces, by surface number, with which kernels refine and shade hits. They
/// are in double for rays of both precisions. A sphere takes 36 bytes.
class PackedShapes {
public:
    explicit PackedShapes(const LoweredScene& lowered);

    /// Updates the shapes of surfaces that have moved; each is still of its kind.
    void move(const LoweredScene& lowered);

    /// Valid as long as this object, also after the object itself is moved.
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
