#pragma once

#include "kernel_abi/shapes.hpp"

#include <cstdint>

// A bounding volume hierarchy of eight children a node, as the kernels walk it.
namespace packtrace::abi {

inline constexpr int node_width = 8;

/// No hierarchy has more levels of nodes than this.
inline constexpr int bvh_levels = 48;

/// Rays and boxes with coordinates beyond this are not told apart by the hierarchy's single
/// precision: such objects stay in lists, and such rays are held against everything.
inline constexpr float largest_coordinate = 1e15f;

/// Boxes of eight children side by side, single precision in every kernel. They hold what they
/// bound with room for its rounding to either precision. An absent child's box is inside out.
struct alignas(64) BvhNode {
    float low[3][node_width];
    float high[3][node_width];
    std::uint32_t child[node_width];  ///< see below
};

// A child is a node by its index, a block of spheres, or a run of objects of one other kind.
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

/// The spheres of one leaf; unused places have a negative radius, which nothing hits.
template <class Real>
struct alignas(64) SphereBlock {
    Real center[3][node_width];
    Real radius[node_width];
};

template <class Real>
struct BvhView {
    const BvhNode* nodes = nullptr;  ///< the first is the root
    /// Null in the double view of a scene in single precision, whose few rays make them of
    /// `shapes`.
    const SphereBlock<Real>* blocks = nullptr;
    const std::int32_t* block_surfaces = nullptr;   ///< eight a block, apart: only hits need them
    const std::int32_t* run_surfaces = nullptr;     ///< of the objects in runs, quadrics first
    const QuadricRecord<Real>* quadrics = nullptr;  ///< likewise null
    const PolygonRecord<Real>* polygons = nullptr;  ///< likewise; those after the quadrics
    int quadric_count = 0;
    const ShapesView* shapes = nullptr;
    int node_count = 0;  ///< 0: the scene has no hierarchy, its lists hold everything
    /// Largest magnitude of a coordinate of the root's box.
    float extent = 0;
    /// Centre of the root's box, and half its diagonal.
    float middle[3] = {};
    float radius = 0;
    /// How far rounding moved a sphere's centre, at most.
    float center_error = 0;
    /// How far rounding shifts hits at most, as a share of the distances there are.
    float slack = 0;
    /// Rays of a cell whose directions differ by more than this share of their length lead to too
    /// many different leaves to be taken as one.
    float spread = 0;

    bool empty() const
    {
        return node_count == 0;
    }
};

}  // namespace packtrace::abi
