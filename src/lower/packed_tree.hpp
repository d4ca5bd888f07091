#pragma once

#include "bvh/bvh.hpp"
#include "core/aligned_array.hpp"
#include "kernel_abi/bvh_view.hpp"
#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Refits the BVH of a scene to the boxes of objects that have moved; each is still of its kind.
void refit_tree(const LoweredScene& lowered, Bvh& bvh);

/// The BVH of a scene (tree_objects.hpp says over which objects), as arrays in the precision that
/// the kernels read.
template <class Real>
class PackedTree {
public:
    PackedTree() = default;
    /// `keep`, if given, receives the BVH for refit().
    explicit PackedTree(const LoweredScene& lowered, Bvh* keep = nullptr);

    /// Packs the objects anew, and the boxes of `bvh`, from which this was made and which
    /// refit_tree() has refitted.
    void refit(const LoweredScene& lowered, const Bvh& bvh);

    /// Valid as long as this object; empty for a default one.
    [[nodiscard]] const abi::BvhView<Real>& view() const
    {
        return view_;
    }

    /// The same BVH for rays in double; spheres in its leaves are made from `shapes`.
    [[nodiscard]] abi::BvhView<double> wide_view(const abi::ShapesView& shapes) const;

    /// Sets where the shapes of all surfaces are, in double.
    void set_shapes(const abi::ShapesView& shapes)
    {
        view_.shapes = &shapes;
    }

    [[nodiscard]] bool holds_spheres_alone() const
    {
        return run_surfaces_.size() == 0;
    }

    /// Number of blocks, of eight spheres each.
    [[nodiscard]] int block_count() const
    {
        return static_cast<int>(blocks_.size());
    }

    [[nodiscard]] std::size_t bytes() const
    {
        return nodes_.bytes() + blocks_.bytes() + block_surfaces_.bytes() + quadrics_.bytes() +
               polygons_.bytes() + polygon_corners_.bytes() + run_surfaces_.bytes();
    }

private:
    void pack_leaves(const LoweredScene& lowered, const Bvh& bvh);
    void bound_root(const abi::BvhNode& root);
    template <class Object, class Record>
    void pack_run(const std::vector<Object>& objects, const Bvh& bvh, const BvhLeaf& leaf,
                  std::size_t first, std::size_t base, AlignedArray<Record>& records);
    void pack_block(const LoweredScene& lowered, const Bvh& bvh, const BvhLeaf& leaf,
                    std::uint32_t index);

    AlignedArray<abi::BvhNode> nodes_;
    AlignedArray<abi::SphereBlock<Real>> blocks_;
    AlignedArray<std::int32_t> block_surfaces_;
    AlignedArray<std::int32_t> run_surfaces_;
    AlignedArray<abi::QuadricRecord<Real>> quadrics_;
    AlignedArray<abi::PolygonRecord<Real>> polygons_;
    PackedCorners<Real> polygon_corners_;
    abi::BvhView<Real> view_;
};

}  // namespace packtrace
