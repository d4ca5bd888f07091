#pragma once

#include "kernel_abi/observation.hpp"
#include <packtrace/certainty.hpp>
#include <packtrace/profile.hpp>

#include <optional>
#include <vector>

// The counts of a frame's kernels, by generation, as named rows.
namespace packtrace {

[[nodiscard]] std::vector<LaneUse> lane_rows(const std::vector<abi::WorkCounts>& counts);

[[nodiscard]] std::vector<TestUse> test_rows(const std::vector<abi::WorkCounts>& counts);

/// Rays of each kind and generation, with the seconds of their stages.
[[nodiscard]] std::vector<RayTime> ray_rows(const std::vector<abi::WorkCounts>& counts,
                                            const std::vector<KernelStage>& stages);

/// The share of lanes with a ray in the packets of a generation; none if it has no packets.
[[nodiscard]] std::optional<double> lanes_filled(const abi::WorkCounts& counts, int lanes);

/// Adds the numbers of a generation's unsure rays by cause, for all purposes.
void add_causes(const abi::WorkCounts& counts, UnsureCounts& sum);

/// Unsure rays by generation, purpose and cause.
[[nodiscard]] std::vector<UnsureUse> unsure_rows(const std::vector<abi::WorkCounts>& counts);

}  // namespace packtrace
