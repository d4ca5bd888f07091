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

/// What Traversal::automatic comes to for pictures, by kernels of so many lanes. PackedScene's own
/// choice is for streams of rays.
[[nodiscard]] Traversal frame_traversal(const LoweredScene& lowered, Traversal traversal,
                                        int lanes);

/// What casts shadows, where not all does.
[[nodiscard]] LoweredScene shadow_casters(const LoweredScene& lowered);

/// A lowered scene in the arrays and the precision the kernels read. Values are rounded once,
/// from double, here.
template <class Real>
class PackedScene {
public:
    /// Where `keep` is given and the scene gets a hierarchy, `keep` becomes the tree that refit()
    /// needs.
    explicit PackedScene(const LoweredScene& lowered, Traversal traversal = Traversal::automatic,
                         Bvh* keep = nullptr);
    PackedScene(const PackedScene&) = delete;
    PackedScene& operator=(const PackedScene&) = delete;

    /// Takes over where objects are now that `bvh` holds, after refit_tree(). Each is still of its
    /// kind; objects that lists hold have not moved. For scenes whose objects all cast shadows.
    void refit(const LoweredScene& lowered, const Bvh& bvh);

    /// Valid as long as this object.
    [[nodiscard]] const abi::SceneView<Real>& view() const
    {
        return view_;
    }

    /// What casts shadows: this, or a scene of its own.
    [[nodiscard]] const PackedScene& casters() const
    {
        return casters_ ? *casters_ : *this;
    }

    /// From how many rays towards a light on that share no way its view of the hierarchy pays for
    /// itself; no number is large enough where there is none.
    [[nodiscard]] double rays_for_light_buffer() const;

    /// The view of one light, where rays_for_light_buffer() is a number.
    [[nodiscard]] PackedLightBuffer light_buffer(const abi::LightRecord<Real>& light) const;

    /// What is held all in all.
    [[nodiscard]] std::size_t bytes() const
    {
        return sizeof *this + tree_.bytes() + lists_.bytes() + shapes_.bytes() +
               (wide_lists_ ? wide_lists_->bytes() : 0) + material_index_.bytes() +
               materials_.bytes() + checkers_.bytes() + ior_.bytes() + lights_.bytes() +
               most_light_.bytes() + (casters_ ? casters_->bytes() : 0);
    }

private:
    void pack_wide(const LoweredScene& lowered);
    void pack_materials(const LoweredScene& lowered);
    void pack_ior(const LoweredScene& lowered);
    void pack_min_weight(const LoweredScene& lowered);
    void pack_lights(const LoweredScene& lowered);
    void choose_light_ends(const LoweredScene& lowered);
    void pack_casters(const LoweredScene& lowered);

    PackedTree<Real> tree_;
    PackedLists<Real> lists_;
    PackedShapes shapes_;
    std::unique_ptr<PackedLists<double>> wide_lists_;  // where rays may be traced again in double
    abi::GeometryView<double> wide_;
    AlignedArray<abi::MaterialIndex> material_index_;
    AlignedArray<abi::MaterialRecord<Real>> materials_;
    AlignedArray<abi::CheckerRecord<Real>> checkers_;
    AlignedArray<Real> ior_;
    AlignedArray<abi::LightRecord<Real>> lights_;
    AlignedArray<abi::MostLight> most_light_;  // where some rays are not traced
    std::unique_ptr<PackedScene> casters_;     // where some objects cast no shadow, the others
    abi::SceneView<Real> view_;
};

}  // namespace packtrace
