#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "lab/harness/ray_trees.hpp"
#include "lower/lowered_scene.hpp"
#include <packtrace/report.hpp>

#include <cstdint>
#include <functional>

// The variants of a scene that are compared (the table, report_variants(), is public), made ready.
namespace packtrace {

/// A variant ready to run on one scene.
struct Subject {
    Variant variant;
    /// Renders a frame; what is made ready once for many frames is ready.
    std::function<void()> render;
    std::function<Image<double>()> picture;  ///< of the last frame
    std::function<std::uint64_t()> rays;     ///< of the last frame
    std::function<CutRays()> cut;            ///< of the last frame
    /// For a pixel of one sample; empty where there is none.
    TreeOfPixel tree;
};

/// Makes a variant of the table ready.
[[nodiscard]] Subject subject_of(const Scene& scene, const Variant& variant);

/// Packets on a scene lowered already, with the kernels of any table. `Real` is that of the
/// variant's precision.
template <class Real>
[[nodiscard]] Subject packet_subject(const Scene& scene, const LoweredScene& lowered,
                                     const abi::KernelTable& table, const Variant& variant);

}  // namespace packtrace
