#pragma once

#include "kernel_abi/observation.hpp"
#include <packtrace/certainty.hpp>
#include <packtrace/profile.hpp>

#include <optional>
#include <vector>

// What a frame's kernels counted, by generation, as rows that name it.
namespace packtrace {

[[nodiscard]] std::vector<LaneUse> lane_rows(const std::vector<abi::WorkCounts>& counts);

[[nodiscard]] std::vector<TestUse> test_rows(const std::vector<abi::WorkCounts>& counts);

/// Rays of each kind and generation, with what the stages of their own took.
[[nodiscard]] std::vector<RayTime> ray_rows(const std::vector<abi::WorkCounts>& counts,
                                            const std::vector<KernelStage>& stages);

/// The share of lanes with a ray in the packets that a generation is traced in; none without any.
[[nodiscard]] std::optional<double> lanes_filled(const abi::WorkCounts& counts, int lanes);

/// Adds a generation's rays traced again in double, whatever they are for.
void add_causes(const abi::WorkCounts& counts, UnsureCounts& sum);

/// Those of all generations.
[[nodiscard]] std::vector<UnsureUse> unsure_rows(const std::vector<abi::WorkCounts>& counts);

}  // namespace packtrace
