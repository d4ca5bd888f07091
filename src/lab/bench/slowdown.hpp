#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/harness/statistics.hpp"

// Whether something takes longer than it did: a verdict on samples, whoever measured them.
namespace packtrace {

/// How much longer one thing takes than another, as a share of what the other takes: 0.1 is a
/// tenth longer.
struct Slowdown {
    double estimate = 0.0;
    /// Holds the true one with `confidence`. None for too few samples.
    std::optional<Interval> interval;
};

/// now[i] and before[i] were measured right after each other: by the median of the logarithms of
/// their ratios.
[[nodiscard]] Slowdown paired_slowdown(const std::vector<double>& now,
                                       const std::vector<double>& before);

/// Measured apart: by the shift between their logarithms. What the machine did differently in the
/// meantime is not in the interval.
[[nodiscard]] Slowdown unpaired_slowdown(const std::vector<double>& now,
                                         const std::vector<double>& before);

enum class Verdict {
    not_slower,  ///< than the limit allows: all of the interval lies within it
    slower,      ///< all of the interval lies beyond the limit
    cannot_tell  ///< the interval has the limit in it, or there is none
};

[[nodiscard]] Verdict verdict_of(const Slowdown& slowdown, double limit);

}  // namespace packtrace
