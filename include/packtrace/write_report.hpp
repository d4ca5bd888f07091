#pragma once

#include <packtrace/export.hpp>
#include <packtrace/report.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace packtrace {

/// The machine and the build that a report was made with.
struct ReportConditions {
    std::string processor;
    int processors = 1;  ///< number of processors the program may use
    std::string compiler;
    std::string commit;
    std::string command;
    std::string flags = {};  ///< compiler flags of the kernels
    /// Load average (programs that run or wait) at the start of the program.
    double load_before = 0.0;
    double load_after = 0.0;  ///< load average after the last measurement
};

/// Writes report.md, report.csv, report.json and report.html into `folder`, which it creates. Each
/// scene gets a folder of its own name with pictures, heat maps and plots. Files appear complete or
/// not at all. gnuplot draws the plots. Throws ImageError if a picture cannot be written, and
/// std::runtime_error if another file cannot be written or gnuplot cannot be run. Throws
/// std::invalid_argument if two scenes have one name, and for a name that report_folder_name()
/// would change.
PACKTRACE_API void write_report(const std::vector<SceneReport>& scenes,
                                const ReportOptions& options, const ReportConditions& conditions,
                                const std::filesystem::path& folder);

/// Turns a scene's name into the name of its folder in the report: printable UTF-8 that is not a
/// path, does not begin with a dot, and is not the name of one of the report's files.
[[nodiscard]] PACKTRACE_API std::string report_folder_name(const std::string& name);

}  // namespace packtrace
