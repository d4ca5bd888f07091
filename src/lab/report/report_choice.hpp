#pragma once

#include <vector>

#include <packtrace/report.hpp>

#include "lab/harness/statistics.hpp"

// Which runs of a study to take, by their times as far as these can be told apart.
namespace packtrace {

/// The middle half of a run's times, seconds; its median where there are none.
[[nodiscard]] Interval middle_times(const ReportRun& run);

/// Whether the middle halves of their times do not overlap, and that of `run` is the lower.
[[nodiscard]] bool surely_faster(const ReportRun& run, const ReportRun& other);

/// Sets each run's standing among the others.
void mark_pareto(std::vector<ReportRun>& runs);

}  // namespace packtrace
