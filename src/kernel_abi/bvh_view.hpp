#pragma once

#include "kernel_abi/shapes.hpp"

#include <cstdint>

// A bounding volume hierarchy (BVH) with eight children per node, as the kernels traverse it.
namespace packtrace::abi {

inline constexpr int node_width = 8;

/// No BVH has more levels of nodes than this.
inline constexpr int bvh_levels = 48;

/// The boxes of a BVH are in single precision. Objects with coordinates beyond this magnitude stay
/// in lists, and rays with such coordinates are tested against every box.
inline constexpr float largest_coordinate = 1e15f;

/// The boxes of eight children, side by side, in single precision for every kernel. Each box is
/// wide enough to hold its objects after they are rounded to either precision. The box of an absent
/// child has low > high.
struct alignas(64) BvhNode {
    float low[3][node_width];
    float high[3][node_width];
    std::uint32_t child[node_width];  ///< see below
};

// A child is one of three: a node, given by its index; a block of spheres; or a run of objects of
// one other kind.
inline constexpr std::uint32_t leaf_bit = 1u << 31;
inline constexpr std::uint32_t run_bit = 1u << 30;
inline constexpr int run_count_shift = 27;  ///< three bits: count - 1
inline constexpr std::uint32_t block_mask = run_bit - 1;
inline constexpr std::uint32_t run_mask = (1u << run_count_shift) - 1;

constexpr bool is_leaf(std::uint32_t child)
{
    return (child & leaf_bit) != 0;
}
constexpr bool is_run(std::uint32_t child)
{
    return (child & run_bit) != 0;
}
constexpr int first_of_run(std::uint32_t child)
{
    return static_cast<int>(child & run_mask);
}
constexpr int run_count(std::uint32_t child)
{
    return static_cast<int>(child >> run_count_shift & 7) + 1;
}

/// The spheres of one leaf. Unused slots have a negative radius, so that no ray hits them.
template <class Real>
struct alignas(64) SphereBlock {
    Real center[3][node_width];
    Real radius[node_width];
};

template <class Real>
struct BvhView {
    const BvhNode* nodes = nullptr;  ///< the first is the root
    /// Null in the double-precision view of a scene in single precision: the few rays traced in
    /// double make the blocks from `shapes`.
    const SphereBlock<Real>* blocks = nullptr;
    /// Eight per block; a separate array, as only hits read it.
    const std::int32_t* block_surfaces = nullptr;
    const std::int32_t* run_surfaces = nullptr;     ///< of the objects in runs, quadrics first
    const QuadricRecord<Real>* quadrics = nullptr;  ///< null likewise
    /// Null likewise; the objects in runs after the quadrics.
    const PolygonRecord<Real>* polygons = nullptr;
    int quadric_count = 0;
    const ShapesView* shapes = nullptr;
    int node_count = 0;  ///< 0: the scene has no BVH, its lists hold all objects
    /// Largest magnitude of a coordinate of the root's box.
    float extent = 0;
    /// Centre of the root's box, and half its diagonal.
    float middle[3] = {};
    float radius = 0;
    /// Upper bound of how far rounding moved the centre of any sphere.
    float center_error = 0;
    /// Upper bound of how far rounding shifts hits, as a share of the distances in the scene.
    float slack = 0;
    /// If the directions of a cell's rays differ by more than this share of their length, the rays
    /// hit too many different leaves to be traversed together.
    float spread = 0;

    bool empty() const
    {
        return node_count == 0;
    }
};

}  // namespace packtrace::abi
