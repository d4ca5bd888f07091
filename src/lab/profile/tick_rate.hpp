#pragma once

#include <cstdint>
#include <vector>

namespace packtrace {

/// The same moment by the processor's counter and by the clock; the second may be read late, when
/// other programs got in between.
struct ClockReading {
    std::uint64_t tick = 0;
    double seconds = 0.0;
};

/// Seconds a tick, of at least two readings in the order they were taken: the median of the
/// slopes between each reading and the one half the readings later, which a few late ones do not
/// move. Sen, Estimates of the Regression Coefficient Based on Kendall's Tau, 1968.
[[nodiscard]] double seconds_of_tick(const std::vector<ClockReading>& readings);

}  // namespace packtrace
