#include "lab/bench/slowdown.hpp"

#include <cmath>

namespace packtrace {
namespace {

std::vector<double> logarithms(std::vector<double> values)
{
    for (double& value : values)
        value = std::log(value);
    return values;
}

// From logarithms of ratios back to shares.
Slowdown of_logarithms(double estimate, const std::optional<Interval>& interval)
{
    Slowdown result{std::expm1(estimate), {}};
    if (interval)
        result.interval = Interval{std::expm1(interval->low), std::expm1(interval->high)};
    return result;
}

}  // namespace

Slowdown paired_slowdown(const std::vector<double>& now, const std::vector<double>& before)
{
    const std::vector<double> ratios = differences(logarithms(now), logarithms(before));
    return of_logarithms(median_of(ratios), median_interval(ratios));
}

Slowdown unpaired_slowdown(const std::vector<double>& now, const std::vector<double>& before)
{
    const std::vector<double> a = logarithms(now);
    const std::vector<double> b = logarithms(before);
    return of_logarithms(shift(a, b), shift_interval(a, b));
}

Verdict verdict_of(const Slowdown& slowdown, double limit)
{
    if (!slowdown.interval)
        return Verdict::cannot_tell;
    if (slowdown.interval->low > limit)
        return Verdict::slower;
    return slowdown.interval->high <= limit ? Verdict::not_slower : Verdict::cannot_tell;
}

}  // namespace packtrace
