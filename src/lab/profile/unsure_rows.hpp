#pragma once

#include <packtrace/certainty.hpp>
#include <packtrace/profile.hpp>

#include "kernel_abi/observation.hpp"

namespace packtrace {

/// Adds a generation's rays traced again in double, whatever they are for.
void add_causes(const abi::WorkCounts& counts, UnsureCounts& sum);

/// The same of all generations, as rows that name them.
[[nodiscard]] std::vector<UnsureUse> unsure_rows(const std::vector<abi::WorkCounts>& counts);

}  // namespace packtrace
