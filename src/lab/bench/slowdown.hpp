#pragma once

#include "lab/harness/statistics.hpp"

#include <cmath>
#include <optional>
#include <vector>

// Whether something takes longer than it did: a verdict on samples, whoever measured them.
namespace packtrace {

/// How much longer one thing takes than another, as a share of what the other takes: 0.1 is a
/// tenth longer.
struct Slowdown {
    double estimate = 0.0;
    /// Holds the true one with `confidence`. None for too few samples.
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

/// now[i] and before[i] were measured right after each other: by the median of the logarithms of
/// their ratios.
[[nodiscard]] inline Slowdown paired_slowdown(const std::vector<double>& now,
                                              const std::vector<double>& before)
{
    const std::vector<double> ratios = differences(logarithms_of(now), logarithms_of(before));
    return slowdown_of_logarithms(median_of(ratios), median_interval(ratios));
}

/// Measured apart: by the shift between their logarithms. What the machine did differently in the
/// meantime is not in the interval.
[[nodiscard]] inline Slowdown unpaired_slowdown(const std::vector<double>& now,
                                                const std::vector<double>& before)
{
    const std::vector<double> a = logarithms_of(now);
    const std::vector<double> b = logarithms_of(before);
    return slowdown_of_logarithms(shift(a, b), shift_interval(a, b));
}

enum class Verdict {
    not_slower,  ///< than the limit allows: all of the interval lies within it
    slower,      ///< all of the interval lies beyond the limit
    cannot_tell  ///< the interval has the limit in it, or there is none
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
