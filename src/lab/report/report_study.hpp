#pragma once

#include <vector>

#include <packtrace/report.hpp>

#include "lab/harness/report_subject.hpp"
#include "lab/truth/truth.hpp"

namespace packtrace {

/// Runs the subjects of one study in turns and holds them against the truth, of which they are
/// pictures of `scene`.
[[nodiscard]] StudyReport run_study(const Scene& scene, Study study, const Truth& truth,
                                    const std::vector<Subject>& subjects,
                                    const ReportOptions& options);

}  // namespace packtrace
