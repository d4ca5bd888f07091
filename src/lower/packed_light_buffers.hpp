#pragma once

#include "core/aligned_array.hpp"
#include "kernel_abi/bvh_view.hpp"
#include "kernel_abi/light_buffer.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/shading.hpp"

namespace packtrace {

/// One light's view of the spheres of a hierarchy, in the arrays the kernels read.
class PackedLightBuffer {
public:
    PackedLightBuffer() = default;
    /// Empty where a point light is too near to the spheres to see all of them ahead of it, and
    /// where most spheres are in each other, so that it would take far more room than they.
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
