#pragma once

#include "cli/options/common_options.hpp"
#include <packtrace/report.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// The parts of `report` that packtrace-mpi shares: all except the order of the work.
namespace packtrace::cli {

/// The arguments of `report`, on one machine or many ranks.
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
    std::string command;  ///< the command line as typed
};

void add_report_options(CLI::App& command, ReportArguments& arguments);

/// The command line as typed, with the program's name without its folder.
[[nodiscard]] std::string report_command(const std::string& program, const CLI::App& command,
                                         const ReportArguments& arguments);

[[nodiscard]] ReportOptions report_options(const ReportArguments& arguments);

/// Throws if the report could not be written: gnuplot is missing, or the folder cannot be created.
void check_report_target(const ReportArguments& arguments);

/// The largest number of threads of the report's runs.
[[nodiscard]] int report_threads(const ReportOptions& options);

/// Prints the recommended runs of a scene.
void print_judgement(const SceneReport& scene, const ReportOptions& options);

/// Writes the report into its folder. If that fails, the files it created are removed again.
void write_whole_report(const std::vector<SceneReport>& reports, const ReportOptions& options,
                        const ReportArguments& arguments);

}  // namespace packtrace::cli
