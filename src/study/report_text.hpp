#pragma once

#include <string>

#include <packtrace/write_report.hpp>

// The parts of a written report, each as the text of its file.
namespace packtrace {

/// "arithmetic", "depth", "sampling".
[[nodiscard]] const char* name_of(Study study);

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
    std::string ids;  ///< with spaces between
};
[[nodiscard]] std::vector<PlotGroup> plot_groups(const StudyReport& study);
[[nodiscard]] std::string report_html(const std::vector<SceneReport>& scenes,
                                      const ReportOptions& options,
                                      const ReportConditions& conditions);

/// The lines that say which run to take; plain sentences.
[[nodiscard]] std::vector<std::string> judgement(const StudyReport& study,
                                                 const ReportOptions& options);

/// Why a run's pixels are off, in a few words: "silhouette 12, shadow edge 3".
[[nodiscard]] std::string shares_text(const ReportRun& run);

[[nodiscard]] std::string brief(double value, int digits = 3);

}  // namespace packtrace
