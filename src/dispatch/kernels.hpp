#pragma once

#include "dispatch/crowding.hpp"
#include "kernel_abi/kernel_table.hpp"

#include <stdexcept>
#include <string_view>
#include <vector>

namespace packtrace {

/// The kernels compiled in, narrowest first; those this machine cannot run too.
[[nodiscard]] const std::vector<const abi::KernelTable*>& all_kernels();

/// Whether this machine, and its operating system, run every instruction `isa` was compiled
/// with.
[[nodiscard]] bool cpu_runs(std::string_view isa);

/// The kernels of an instruction set that list_isas() names as supported. Throws
/// std::invalid_argument for any other.
[[nodiscard]] const abi::KernelTable& kernels_of(std::string_view isa);

/// The half of a table that works in `Real`.
template <class Real>
[[nodiscard]] const abi::PrecisionTable<Real>& precision(const abi::KernelTable& table);

/// The narrowest kernels that know everything a scene uses.
template <class Real>
[[nodiscard]] const abi::FeatureKernels<Real>& kernels_for(const abi::PrecisionTable<Real>& table,
                                                           abi::Features needed)
{
    for (const auto& kernels : table.kernels)
        if (kernels.render_tiles != nullptr && abi::covers(kernels.set.features, needed))
            return kernels;
    throw std::logic_error("no kernels know all that the scene uses");
}

/// Where lines cross more objects than this, neighbouring paths soon part, and streams bring those
/// together again that go on (results/crowding.json).
inline constexpr double most_crossed_in_registers = 1.75;

/// The kernels that trace frames of a scene in registers; null where streams trace them.
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

/// Whether several tiles of a frame are rendered together, with their mirrored rays sorted: where
/// these go down a hierarchy. Glass sends two rays on, whose light has an order of its own.
template <class Real>
[[nodiscard]] bool sorts_mirrored(abi::Features needed, const abi::SceneView<Real>& scene)
{
    return scene.rules.max_depth > 0 && !needed.glass && !scene.tree.empty();
}

}  // namespace packtrace
