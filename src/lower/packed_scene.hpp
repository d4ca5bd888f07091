#pragma once

#include <packtrace/traversal.hpp>

#include "core/aligned_array.hpp"
#include "kernel_abi/scene_view.hpp"
#include "lower/lowered_scene.hpp"
#include "lower/packed_tree.hpp"

namespace packtrace {

/// A lowered scene in the arrays and the precision the kernels read. Values are rounded once,
/// from double, here.
template <class Real>
class PackedScene {
public:
    explicit PackedScene(const LoweredScene& lowered, Traversal traversal = Traversal::automatic);

    /// Valid as long as this object.
    [[nodiscard]] const abi::SceneView<Real>& view() const
    {
        return view_;
    }

private:
    template <class Object>
    [[nodiscard]] bool in_tree(const Object& object) const
    {
        return !tree_.view().empty() && fits_tree(object);
    }

    void pack_spheres(const LoweredScene& lowered);
    void pack_huge_spheres(const LoweredScene& lowered);
    void pack_planes(const LoweredScene& lowered);
    void pack_quadrics(const LoweredScene& lowered);
    void pack_stiff(const LoweredScene& lowered);
    void pack_finish(const LoweredScene& lowered);
    void pack_forms(const LoweredScene& lowered);
    void pack_normals(const LoweredScene& lowered);
    void pack_materials(const LoweredScene& lowered);
    void pack_lights(const LoweredScene& lowered);

    PackedTree<Real> tree_;
    AlignedArray<Real> sphere_reals_;
    AlignedArray<abi::lane_int<Real>> sphere_surfaces_;
    AlignedArray<abi::HugeSphere<Real>> huge_spheres_;
    AlignedArray<abi::PlaneRecord<Real>> planes_;
    AlignedArray<abi::QuadricRecord<Real>> quadrics_;
    AlignedArray<abi::StiffObject> stiff_;
    AlignedArray<abi::StiffObject> finish_;
    AlignedArray<std::int32_t> finish_index_;
    AlignedArray<abi::SurfaceForm> forms_;
    AlignedArray<abi::SurfaceRecord<Real>> surfaces_;
    AlignedArray<abi::CurvedSurfaceRecord<Real>> curved_surfaces_;
    AlignedArray<abi::MaterialIndex> material_index_;
    AlignedArray<abi::MaterialRecord<Real>> materials_;
    AlignedArray<abi::CheckerRecord<Real>> checkers_;
    AlignedArray<Real> ior_;
    AlignedArray<abi::LightRecord<Real>> lights_;
    abi::SceneView<Real> view_;
};

}  // namespace packtrace
