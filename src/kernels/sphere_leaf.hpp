#pragma once

#include "kernels/ray_group.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// The spheres of a leaf, and their surface numbers, which only hits ask for.
template <class Real>
struct SphereLeaf {
    const abi::SphereBlock<Real>& block;
    const lane_int<Real>* surface;

    [[nodiscard]] std::int32_t surface_of(int slot) const
    {
        return static_cast<std::int32_t>(surface[slot]);
    }
};

template <class Real>
inline SphereLeaf<Real> sphere_leaf(const abi::BvhView<Real>& tree, std::uint32_t child)
{
    const std::uint32_t index = child & abi::block_mask;
    return {tree.blocks[index], tree.block_surfaces + std::size_t{index} * abi::node_width};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
