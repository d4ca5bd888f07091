#pragma once

#include "study/stress.hpp"

namespace packtrace::study {

/// The stated bounds that a row breaks, each in a few words. Packets alone have any.
[[nodiscard]] std::vector<std::string> broken_bounds(const StressRow& row);

}  // namespace packtrace::study
