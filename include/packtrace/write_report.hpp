#pragma once

#include <packtrace/export.hpp>
#include <packtrace/report.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace packtrace {

/// Where and how a report was made, for its reader.
struct ReportConditions {
    std::string processor;
    int processors = 1;  ///< that the program may use
    std::string compiler;
    std::string commit;
    std::string command;
    std::string flags = {};  ///< of the compiler, for the kernels
    /// Of the machine when the program started: programs that run or wait.
    double load_before = 0.0;
    double load_after = 0.0;  ///< when all was measured
};

/// Writes report.md, report.csv, report.json and report.html into `folder`, which is made, and for
/// each scene a folder of pictures, heat maps and plots, called as the scene is. Files appear whole
/// or not at all. Plots are drawn by gnuplot. Throws ImageError for a picture, std::runtime_error
/// for another file, or a gnuplot that can't be run, and std::invalid_argument for two scenes of
/// one name or a name that is not what report_folder_name() makes of it.
PACKTRACE_API void write_report(const std::vector<SceneReport>& scenes,
                                const ReportOptions& options, const ReportConditions& conditions,
                                const std::filesystem::path& folder);

/// A scene's name made one for a folder within the report's: printable UTF-8 that is no path, does
/// not begin with a dot, and is none of the report's own files'.
[[nodiscard]] PACKTRACE_API std::string report_folder_name(const std::string& name);

}  // namespace packtrace
