#pragma once

#include "core/text.hpp"
#include "image/color_ramp.hpp"
#include "image/pixel_error.hpp"
#include "lab/report/report_text.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/report.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

// The pictures of a report and their error maps, by their index in StudyReport::pictures.
namespace packtrace {

/// The name of a picture for readers: "truth", or its run and the number of other runs with the
/// same picture.
[[nodiscard]] inline std::string picture_label(const StudyReport& study, std::size_t picture)
{
    const std::string& name = study.pictures[picture].label;
    const auto runs = std::count_if(
        study.runs.begin(), study.runs.end(),
        [&](const ReportRun& run) { return run.picture == picture && run.variant.name != name; });
    if (runs == 0)
        return name;
    if (picture == 0)
        return name + ", as " + counted(runs, "run has it", "runs have it");
    return name + " and " + std::to_string(runs) + " alike";
}

/// The largest finite error of a pixel, which is white in the error map.
[[nodiscard]] inline double largest_error(const StudyReport& study, std::size_t picture)
{
    const Image<double>& truth = study.pictures.front().image;
    const Image<double>& image = study.pictures[picture].image;
    double largest = 0.0;
    for (std::size_t i = 0; i < truth.rgb.size(); i += 3)
        if (const double error = pixel_error(&truth.rgb[i], &image.rgb[i]); std::isfinite(error))
            largest = std::max(largest, error);
    return largest;
}

/// The error that is black in an error map whose white is `largest`; smaller errors are black, too.
[[nodiscard]] inline double least_error_shown(double largest)
{
    return 1e-6 * largest;
}

/// The error map of a picture, without a legend.
[[nodiscard]] inline Image<float> error_map(const StudyReport& study, std::size_t picture)
{
    return heatmap(study.pictures[picture].image, study.pictures.front().image);
}

/// The error map of a picture, above a legend.
[[nodiscard]] inline Image<float> error_map_with_legend(const StudyReport& study,
                                                        std::size_t picture)
{
    const double largest = largest_error(study, picture);
    return with_legend(error_map(study, picture), brief(least_error_shown(largest), 2),
                       brief(largest, 2));
}

}  // namespace packtrace
