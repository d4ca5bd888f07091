#include "lab/profile/tick_rate.hpp"

#include <cstddef>

#include "lab/harness/statistics.hpp"

namespace packtrace {

double seconds_of_tick(const std::vector<ClockReading>& readings)
{
    const std::size_t half = readings.size() / 2;
    std::vector<double> slopes;
    for (std::size_t i = 0; i + half < readings.size(); ++i) {
        const ClockReading& from = readings[i];
        const ClockReading& to = readings[i + half];
        if (to.tick > from.tick)
            slopes.push_back((to.seconds - from.seconds) /
                             static_cast<double>(to.tick - from.tick));
    }
    return slopes.empty() ? 0.0 : median_of(slopes);
}

}  // namespace packtrace
