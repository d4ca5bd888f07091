#pragma once

#include "core/aligned_array.hpp"
#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

/// The shapes hits are shaded by, and in single precision solved again by, as the kernels find
/// them by surface number. A sphere among many costs 36 bytes; few spheres have records as
/// surfaces of all kinds have, which are larger, but need not be made of anything.
template <class Real>
class PackedShapes {
public:
    PackedShapes(const LoweredScene& lowered, bool many_spheres);

    /// Points `view` to the shapes, valid as long as this object.
    void show(abi::SceneView<Real>& view) const;

    [[nodiscard]] std::size_t bytes() const
    {
        return places_.bytes() + spheres_.bytes() + surfaces_.bytes() + curved_.bytes() +
               finish_index_.bytes() + finish_.bytes() + forms_.bytes();
    }

private:
    template <class Visit>
    void for_each_other(const LoweredScene& lowered, const Visit& visit) const;

    void pack_sphere_shapes(const LoweredScene& lowered);
    void place_others(const LoweredScene& lowered);
    void pack_others(const LoweredScene& lowered);
    void pack_curved(const LoweredScene& lowered);
    void pack_finish(const LoweredScene& lowered);
    void pack_forms(const LoweredScene& lowered);
    [[nodiscard]] abi::Sharpened sharpened(const LoweredScene& lowered, std::int32_t surface) const;

    /// Of a surface that is not among the spheres: its place in all arrays but `finish_`.
    [[nodiscard]] std::size_t other(std::int32_t surface) const
    {
        return places_[static_cast<std::size_t>(surface)] & abi::place_mask;
    }

    bool many_spheres_ = false;
    std::size_t others_ = 0;
    bool finishes_ = false;
    AlignedArray<abi::SurfacePlace> places_;
    AlignedArray<abi::SphereShape> spheres_;
    AlignedArray<abi::SurfaceRecord<Real>> surfaces_;
    AlignedArray<abi::CurvedSurfaceRecord<Real>> curved_;
    AlignedArray<std::int32_t> finish_index_;
    AlignedArray<abi::StiffObject> finish_;
    AlignedArray<abi::SurfaceForm> forms_;
    abi::Sharpened most_sharpened_ = abi::Sharpened::nothing;
    abi::Sharpened sharpened_spheres_ = abi::Sharpened::nothing;
    bool met_again_outside_ = false;
};

}  // namespace packtrace
