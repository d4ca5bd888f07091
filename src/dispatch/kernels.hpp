#pragma once

#include "dispatch/crowding.hpp"
#include "kernel_abi/kernel_table.hpp"

#include <stdexcept>
#include <string_view>
#include <vector>

namespace packtrace {

/// All kernels that are compiled in, narrowest first, even if this machine cannot run them.
[[nodiscard]] const std::vector<const abi::KernelTable*>& all_kernels();

/// Whether this machine and its operating system support all instructions that `isa` is compiled
/// with.
[[nodiscard]] bool cpu_runs(std::string_view isa);

/// The kernels of an instruction set that list_isas() names as supported. Throws
/// std::invalid_argument for any other.
[[nodiscard]] const abi::KernelTable& kernels_of(std::string_view isa);

/// The part of a table for `Real`.
template <class Real>
[[nodiscard]] const abi::PrecisionTable<Real>& precision(const abi::KernelTable& table);

/// The kernels with the fewest features that include all features a scene needs.
template <class Real>
[[nodiscard]] const abi::FeatureKernels<Real>& kernels_for(const abi::PrecisionTable<Real>& table,
                                                           abi::Features needed)
{
    for (const auto& kernels : table.kernels)
        if (kernels.render_tiles != nullptr && abi::covers(kernels.set.features, needed))
            return kernels;
    throw std::logic_error("no kernels know all that the scene uses");
}

/// If lines cross more objects than this, neighbouring paths diverge soon, and stream kernels,
/// which compact the rays that continue, are faster (results/crowding.json, crowding_fast.json).
inline constexpr double most_crossed_in_registers = 1.75;

/// The kernels that trace frames of a scene in registers; null if stream kernels trace them.
template <class Real>
[[nodiscard]] const abi::FusedKernels<Real>* fused_for(const abi::PrecisionTable<Real>& table,
                                                       abi::Features needed,
                                                       const abi::SceneView<Real>& scene)
{
    if (crossed_by_a_line(scene) > most_crossed_in_registers)
        return nullptr;
    for (const abi::FusedKernels<Real>& fused : table.fused)
        if (fused.render_tiles != nullptr && abi::covers(fused.features, needed))
            return fused.plan_bytes(scene) > 0 ? &fused : nullptr;
    return nullptr;
}

/// Whether several tiles of a frame are rendered together and their mirrored rays sorted: if the
/// rays traverse a bvh. Not for glass, whose two child rays must add their light in a fixed order.
template <class Real>
[[nodiscard]] bool sorts_mirrored(abi::Features needed, const abi::SceneView<Real>& scene)
{
    return scene.rules.max_depth > 0 && !needed.glass && !scene.tree.empty();
}

}  // namespace packtrace
