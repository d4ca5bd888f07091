#pragma once

#include "core/text.hpp"
#include <packtrace/write_report.hpp>

#include <string>

// The parts of a written report, each as the text of its file.
namespace packtrace {

/// "arithmetic", "depth", "sampling".
[[nodiscard]] const char* name_of(Study study);

/// "yes", "no" or "undecided": whether a run lies on the Pareto front.
[[nodiscard]] const char* name_of(Pareto standing);

/// Names of a scene's files, from the report's folder.
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
/// What belongs together in that plot: the SVG groups of a series, by their ids.
struct PlotGroup {
    std::string name;
    std::string ids;    ///< with spaces between
    std::string color;  ///< #rrggbb
};
[[nodiscard]] std::vector<PlotGroup> plot_groups(const StudyReport& study);
/// All of a report in one page, which needs no other file and, for all but choosing pictures, no
/// script.
[[nodiscard]] std::string report_html(const std::vector<SceneReport>& scenes,
                                      const ReportOptions& options,
                                      const ReportConditions& conditions);

/// The lines that say which run to take; plain sentences.
[[nodiscard]] std::vector<std::string> judgement(const StudyReport& study,
                                                 const ReportOptions& options);

/// Why a run's pixels are off, in a few words: "silhouette 12, shadow edge 3".
[[nodiscard]] std::string shares_text(const ReportRun& run);

/// The same in brackets where no pixel is off, and the worst ones were looked at.
[[nodiscard]] std::string where_text(const ReportRun& run);

/// Million rays a second, to three digits; empty for runs that do not count them.
[[nodiscard]] std::string mrays_text(const ReportRun& run);

/// The spread in per cent: "3.1 %", "240 %".
[[nodiscard]] std::string spread_text(const ReportRun& run);

/// What the classes of error in these reports mean, each once.
[[nodiscard]] std::vector<ErrorShare> classes_of(const std::vector<SceneReport>& scenes);

}  // namespace packtrace
