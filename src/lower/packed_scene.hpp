#pragma once

#include "core/aligned_array.hpp"
#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"
#include "lower/packed_light_buffers.hpp"
#include "lower/packed_lists.hpp"
#include "lower/packed_shapes.hpp"
#include "lower/packed_tree.hpp"
#include <packtrace/traversal.hpp>

#include <memory>
#include <vector>

namespace packtrace {

/// What Traversal::automatic chooses for pictures, with kernels of so many lanes. PackedScene
/// itself chooses for streams of rays.
[[nodiscard]] Traversal frame_traversal(const LoweredScene& lowered, Traversal traversal,
                                        int lanes);

/// The scene without the surfaces that cast no shadow; lowered.casts_shadow is not empty.
[[nodiscard]] LoweredScene shadow_casters(const LoweredScene& lowered);

/// A lowered scene as arrays in the precision that the kernels read. Values are rounded here, once,
/// from double.
template <class Real>
class PackedScene {
public:
    /// `keep`, if given, receives the scene's BVH, if it has one, for refit().
    explicit PackedScene(const LoweredScene& lowered, Traversal traversal = Traversal::automatic,
                         Bvh* keep = nullptr);
    PackedScene(const PackedScene&) = delete;
    PackedScene& operator=(const PackedScene&) = delete;

    /// Updates the objects in `bvh`, which have moved, after refit_tree(). Each is still of its
    /// kind, and objects in lists have not moved. For scenes whose objects all cast shadows.
    void refit(const LoweredScene& lowered, const Bvh& bvh);

    /// Valid as long as this object.
    [[nodiscard]] const abi::SceneView<Real>& view() const
    {
        return view_;
    }

    /// The scene of the occluders: this one, or one without the objects that cast no shadow.
    [[nodiscard]] const PackedScene& casters() const
    {
        return casters_ ? *casters_ : *this;
    }

    /// From how many spread shadow rays on the buffer of a light pays for being built; infinite
    /// where lights can't have one.
    [[nodiscard]] double rays_for_light_buffer() const;

    /// The buffer of one light, where rays_for_light_buffer() is finite.
    [[nodiscard]] PackedLightBuffer light_buffer(const abi::LightRecord<Real>& light) const;

    /// All memory that is held.
    [[nodiscard]] std::size_t bytes() const
    {
        return sizeof *this + bvh_.bytes() + lists_.bytes() + shapes_.bytes() +
               (wide_lists_ ? wide_lists_->bytes() : 0) + material_index_.bytes() +
               materials_.bytes() + checkers_.bytes() + ior_.bytes() + lights_.bytes() +
               most_light_.bytes() + (casters_ ? casters_->bytes() : 0);
    }

private:
    void pack_wide(const LoweredScene& lowered);
    void pack_rules(const LoweredScene& lowered);
    void pack_materials(const LoweredScene& lowered);
    void pack_ior(const LoweredScene& lowered);
    void pack_min_weight(const LoweredScene& lowered);
    void pack_lights(const LoweredScene& lowered);
    void choose_light_ends(const LoweredScene& lowered);
    void pack_casters(const LoweredScene& lowered);

    PackedTree<Real> bvh_;
    PackedLists<Real> lists_;
    PackedShapes shapes_;
    std::unique_ptr<PackedLists<double>> wide_lists_;  // where rays may be traced again in double
    abi::GeometryView<double> wide_;
    AlignedArray<abi::MaterialIndex> material_index_;
    AlignedArray<abi::MaterialRecord<Real>> materials_;
    AlignedArray<abi::CheckerRecord<Real>> checkers_;
    AlignedArray<Real> ior_;
    AlignedArray<abi::LightRecord<Real>> lights_;
    AlignedArray<abi::MostLight> most_light_;  // with Scene::min_weight
    std::unique_ptr<PackedScene> casters_;     // the occluders, where some objects cast no shadow
    abi::SceneView<Real> view_;
};

}  // namespace packtrace
