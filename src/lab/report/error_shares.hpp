#pragma once

#include <functional>
#include <optional>

#include <packtrace/report.hpp>

#include "lab/report/error_class.hpp"

namespace packtrace {

/// Why a pixel is off, by any means.
using ClassOfPixel = std::function<std::optional<ClassifiedError>(int x, int y)>;

/// Fills in the run's shares: of its pixels that are off or, when there are none, of its worst
/// ones. When they are more than options.classified, some spread evenly over them stand for all.
void find_shares(ReportRun& run, const Image<double>& truth, const Image<double>& picture,
                 const ReportOptions& options, const ClassOfPixel& class_of);

}  // namespace packtrace
