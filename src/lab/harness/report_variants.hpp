#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "lab/harness/ray_trees.hpp"
#include "lower/lowered_scene.hpp"
#include <packtrace/report.hpp>

#include <cstdint>
#include <functional>

// The variants that are compared, prepared for a scene. Their table, report_variants(), is public.
namespace packtrace {

/// A variant prepared for one scene.
struct Subject {
    Variant variant;
    /// Renders a frame. All that many frames share has been prepared.
    std::function<void()> render;
    std::function<Image<double>()> picture;  ///< of the last frame
    std::function<std::uint64_t()> rays;     ///< of the last frame
    std::function<CutRays()> cut;            ///< of the last frame
    /// Ray trees, for variants of one sample per pixel; may be empty.
    TreeOfPixel tree;
};

/// Prepares a variant of the table.
[[nodiscard]] Subject subject_of(const Scene& scene, const Variant& variant);

/// Prepares packets on a lowered scene, with the kernels of any table. `Real` is the variant's
/// precision.
template <class Real>
[[nodiscard]] Subject packet_subject(const Scene& scene, const LoweredScene& lowered,
                                     const abi::KernelTable& table, const Variant& variant);

}  // namespace packtrace
