#pragma once

#include "mpi/job.hpp"
#include "mpi/rank_setup.hpp"
#include "mpi/world.hpp"
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

// The commands, and their common steps: options, the scene, checks of all ranks, and a final
// report.
namespace packtrace::mpi {

// Each function adds its subcommand. All ranks run it together, and all ranks either succeed or
// throw JobFailed.
void add_render(CLI::App& app, const World& world);
void add_intersect(CLI::App& app, const World& world);
void add_report(CLI::App& app, const World& world);
void add_stress(CLI::App& app, const World& world);

/// The options of all packtrace-mpi commands that packtrace does not have.
struct JobArguments {
    bool allow_mixed = false;
    bool json = false;

    [[nodiscard]] Mixing mixing() const
    {
        return allow_mixed ? Mixing::allowed : Mixing::refused;
    }
};

void add_job_options(CLI::App& command, JobArguments& arguments);

/// Returns the scene on every rank. Rank 0 reads the file, or standard input for -, and sends its
/// text. For a name such as "generate random --count 10000000" each rank generates the scene.
/// Throws JobFailed.
[[nodiscard]] Scene shared_scene(const World& world, const std::string& name);

/// The name for the output files of such a scene, from its file or its generator.
[[nodiscard]] std::string shared_scene_stem(const std::string& name);

/// Throws JobFailed if the ranks may not work on one result.
void check_ranks(const World& world, const RenderOptions& options, Mixing mixing);

/// Throws JobFailed if ranks have different versions or instruction sets, because the rows of
/// studies would differ. Without names it compares all sets that the machines support.
void check_same_isas(const World& world, std::vector<std::string> isas);

/// The results of a job, and how to print them.
struct JobReport {
    std::string output;  ///< name of the output
    std::string pieces;  ///< name of the pieces of work
    std::vector<RankReport> ranks = {};
    double seconds = 0.0;
    bool quiet = false;  ///< without the line on standard error
    bool json = false;   ///< instead of the line, a JSON object on standard output
};

/// Called by all ranks together; rank 0 prints.
void print_report(const World& world, const JobReport& report);

}  // namespace packtrace::mpi
