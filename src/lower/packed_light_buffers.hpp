#pragma once

#include "core/aligned_array.hpp"
#include "kernel_abi/bvh_view.hpp"
#include "kernel_abi/light_buffer.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/shading.hpp"

namespace packtrace {

/// The buffer of one light: a grid across the light's view of a BVH of spheres, with the spheres of
/// each cell, as arrays that the kernels read.
class PackedLightBuffer {
public:
    PackedLightBuffer() = default;
    /// Empty where a point light is too near to see all spheres ahead of it, and where so many
    /// spheres overlap that the buffer would take far more memory than the spheres.
    PackedLightBuffer(const abi::LightRecord<float>& light, const abi::BvhView<float>& tree,
                      int blocks);

    /// Valid as long as this object.
    [[nodiscard]] const abi::LightBuffer& view() const
    {
        return view_;
    }

    [[nodiscard]] std::size_t bytes() const
    {
        return cells_.bytes() + blocks_.bytes();
    }

private:
    AlignedArray<abi::LightCell> cells_;
    AlignedArray<abi::LightBlock> blocks_;
    abi::LightBuffer view_;
};

}  // namespace packtrace
