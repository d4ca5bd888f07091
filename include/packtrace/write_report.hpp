#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <packtrace/export.hpp>
#include <packtrace/report.hpp>

namespace packtrace {

/// Where and how a report was made, for its reader.
struct ReportConditions {
    std::string processor;
    int processors = 1;  ///< that the program may use
    std::string compiler;
    std::string commit;
    std::string command;
};

/// Writes report.md, report.csv, report.json and report.html into `folder`, which is made, and for
/// each scene a folder of pictures, heat maps and plots. Files appear whole or not at all. Plots
/// are drawn by gnuplot. Throws FileError and ImageError, and PlotError for a gnuplot that can't be
/// run.
PACKTRACE_API void write_report(const std::vector<SceneReport>& scenes,
                                const ReportOptions& options, const ReportConditions& conditions,
                                const std::filesystem::path& folder);

}  // namespace packtrace
