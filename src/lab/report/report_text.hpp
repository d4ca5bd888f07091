#pragma once

#include "core/text.hpp"
#include <packtrace/write_report.hpp>

#include <string>

// The texts of a written report's files.
namespace packtrace {

/// "arithmetic", "depth", "weight" or "sampling".
[[nodiscard]] const char* name_of(Study study);

/// "yes", "no" or "undecided": whether a run lies on the Pareto front.
[[nodiscard]] const char* name_of(Pareto standing);

/// Names of a scene's files, relative to the report's folder.
[[nodiscard]] std::string picture_file(const SceneReport& scene, const StudyReport& study,
                                       std::size_t picture);
[[nodiscard]] std::string error_file(const SceneReport& scene, const StudyReport& study,
                                     std::size_t picture);
[[nodiscard]] std::string plot_file(const SceneReport& scene, const StudyReport& study);

[[nodiscard]] std::string report_csv(const std::vector<SceneReport>& scenes);
[[nodiscard]] std::string report_json(const std::vector<SceneReport>& scenes,
                                      const ReportOptions& options,
                                      const ReportConditions& conditions);
[[nodiscard]] std::string report_markdown(const std::vector<SceneReport>& scenes,
                                          const ReportOptions& options,
                                          const ReportConditions& conditions);
/// The work-precision diagram of a study, as SVG.
[[nodiscard]] std::string report_plot(const SceneReport& scene, const StudyReport& study);
/// The SVG groups of one series in that plot.
struct PlotGroup {
    std::string name;
    std::string ids;    ///< of the SVG groups, separated by spaces
    std::string color;  ///< #rrggbb
};
[[nodiscard]] std::vector<PlotGroup> plot_groups(const StudyReport& study);
/// The whole report in one page. It needs no other file, and scripts only to choose pictures.
[[nodiscard]] std::string report_html(const std::vector<SceneReport>& scenes,
                                      const ReportOptions& options,
                                      const ReportConditions& conditions);

/// Sentences that say which run to choose.
[[nodiscard]] std::vector<std::string> judgement(const StudyReport& study,
                                                 const ReportOptions& options);

/// The reasons why a run's pixels are off: "silhouette 12, shadow edge 3".
[[nodiscard]] std::string shares_text(const ReportRun& run);

/// The same, in brackets if no pixel is off and the worst pixels were classified.
[[nodiscard]] std::string where_text(const ReportRun& run);

/// Million rays per second, to three digits; empty for runs that do not count rays.
[[nodiscard]] std::string mrays_text(const ReportRun& run);

/// The spread in per cent: "3.1 %", "240 %".
[[nodiscard]] std::string spread_text(const ReportRun& run);

/// The classes of error in these reports, each once.
[[nodiscard]] std::vector<ErrorShare> classes_of(const std::vector<SceneReport>& scenes);

}  // namespace packtrace
