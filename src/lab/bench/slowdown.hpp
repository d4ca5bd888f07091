#pragma once

#include "lab/harness/statistics.hpp"

#include <cmath>
#include <optional>
#include <vector>

// Whether something takes longer than before, by samples of its time.
namespace packtrace {

/// How much longer one thing takes than another, as a share of the other's time: 0.1 is a tenth
/// longer.
struct Slowdown {
    double estimate = 0.0;
    /// Holds the true slowdown with `confidence`. None for too few samples.
    std::optional<Interval> interval;
};

[[nodiscard]] inline std::vector<double> logarithms_of(std::vector<double> values)
{
    for (double& value : values)
        value = std::log(value);
    return values;
}

/// From logarithms of ratios back to shares.
[[nodiscard]] inline Slowdown slowdown_of_logarithms(double estimate,
                                                     const std::optional<Interval>& interval)
{
    Slowdown result{std::expm1(estimate), {}};
    if (interval)
        result.interval = Interval{std::expm1(interval->low), std::expm1(interval->high)};
    return result;
}

/// For samples now[i] and before[i] that were measured right after each other: by the median of the
/// logarithms of their ratios.
[[nodiscard]] inline Slowdown paired_slowdown(const std::vector<double>& now,
                                              const std::vector<double>& before)
{
    const std::vector<double> ratios = differences(logarithms_of(now), logarithms_of(before));
    return slowdown_of_logarithms(median_of(ratios), median_interval(ratios));
}

/// For samples that were measured at different times: by the shift between their logarithms. The
/// interval does not include changes of the machine in the meantime.
[[nodiscard]] inline Slowdown unpaired_slowdown(const std::vector<double>& now,
                                                const std::vector<double>& before)
{
    const std::vector<double> a = logarithms_of(now);
    const std::vector<double> b = logarithms_of(before);
    return slowdown_of_logarithms(shift(a, b), shift_interval(a, b));
}

enum class Verdict {
    not_slower,  ///< the whole interval is within the limit
    slower,      ///< the whole interval is beyond the limit
    cannot_tell  ///< the limit is inside the interval, or there is no interval
};

[[nodiscard]] inline Verdict verdict_of(const Slowdown& slowdown, double limit)
{
    if (!slowdown.interval)
        return Verdict::cannot_tell;
    if (slowdown.interval->low > limit)
        return Verdict::slower;
    return slowdown.interval->high <= limit ? Verdict::not_slower : Verdict::cannot_tell;
}

}  // namespace packtrace
