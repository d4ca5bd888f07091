#pragma once

#include "kernels/traverse/bundle.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// The spheres of a leaf, and their surface numbers, which only hits ask for.
template <class Real>
struct SphereLeaf {
    const abi::SphereBlock<Real>& block;
    const std::int32_t* surface;

    [[nodiscard]] std::int32_t surface_of(int slot) const
    {
        return surface[slot];
    }
};

/// Makes a block of its spheres' shapes.
template <class Real>
[[gnu::noinline]] void gather_block(const abi::BvhView<Real>& tree, const std::int32_t* surfaces,
                                    abi::SphereBlock<Real>& block)
{
    for (int slot = 0; slot < abi::node_width; ++slot) {
        const bool used = surfaces[slot] >= 0;
        const abi::SphereShape nowhere{{1e15, 1e15, 1e15}, -1.0};
        const abi::SphereShape& sphere =
            used ? tree.shapes->spheres[tree.shapes->index[surfaces[slot]].record] : nowhere;
        for (int axis = 0; axis < 3; ++axis)
            block.center[axis][slot] = static_cast<Real>(sphere.center[axis]);
        block.radius[slot] = static_cast<Real>(sphere.radius);
    }
}

/// `room` is for a block that has to be made.
template <class Real>
inline SphereLeaf<Real> sphere_leaf(const abi::BvhView<Real>& tree, std::uint32_t child,
                                    abi::SphereBlock<Real>& room)
{
    const std::uint32_t index = child & abi::block_mask;
    const std::int32_t* const surfaces = tree.block_surfaces + std::size_t{index} * abi::node_width;
    if (sizeof(Real) == sizeof(float) || tree.blocks != nullptr)
        return {tree.blocks[index], surfaces};
    gather_block(tree, surfaces, room);
    return {room, surfaces};
}

/// A quadric of a leaf.
template <class Real>
inline const abi::QuadricRecord<Real>& leaf_quadric(const abi::BvhView<Real>& tree, int number)
{
    if constexpr (sizeof(Real) == sizeof(double))
        if (tree.quadrics == nullptr)
            return tree.shapes->quadrics[tree.shapes->index[tree.quadric_surfaces[number]].record];
    return tree.quadrics[number];
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
