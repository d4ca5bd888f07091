#pragma once

#include "cli/options/common_options.hpp"
#include <packtrace/report.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// The parts of `report` that packtrace-mpi uses, too: all but the order of the work.
namespace packtrace::cli {

/// What `report` takes, on one machine or many ranks.
struct ReportArguments {
    std::vector<std::string> scenes;
    std::filesystem::path folder;
    PictureArguments picture;
    std::optional<int> repetitions;
    std::optional<int> truth_samples;
    std::optional<std::string> cache;
    ReportOptions options;
    double max_time_ms = 20.0;
    bool quick = false;
    bool quiet = false;
    std::string command;  ///< as it was typed
};

void add_report_options(CLI::App& command, ReportArguments& arguments);

/// The command as it was typed, its program by its bare name.
[[nodiscard]] std::string report_command(const std::string& program, const CLI::App& command,
                                         const ReportArguments& arguments);

[[nodiscard]] ReportOptions report_options(const ReportArguments& arguments);

/// What a report can't be written without: gnuplot, and a folder that can be made. Throws.
void check_report_target(const ReportArguments& arguments);

/// As many threads as the runs of a report ask for.
[[nodiscard]] int report_threads(const ReportOptions& options);

/// Prints which runs to take of a scene.
void print_judgement(const SceneReport& scene, const ReportOptions& options);

/// Writes the report into its folder.
void write_whole_report(const std::vector<SceneReport>& reports, const ReportOptions& options,
                        const ReportArguments& arguments);

}  // namespace packtrace::cli
