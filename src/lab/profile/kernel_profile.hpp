#pragma once

#include <packtrace/profile.hpp>

#include "kernel_abi/observation.hpp"

namespace packtrace {

/// What kernels record of themselves in a frame, and the frame.
struct ObservedKernels {
    KernelProfile profile;
    std::vector<abi::WorkCounts> counts;  ///< by generation
    FrameCounts rays;
};

/// Frames of the same scene on one thread, observed and not, in turns.
template <class Real>
[[nodiscard]] ObservedKernels observe_kernels(const Scene& scene, const ProfileOptions& options);

}  // namespace packtrace
