#pragma once

#include <string>
#include <vector>

#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

#include "mpi/job.hpp"
#include "mpi/rank_setup.hpp"
#include "mpi/world.hpp"

// The commands, and the steps that they have in common: options, the scene, checks of all ranks,
// and a report at the end.
namespace packtrace::mpi {

// Each adds its subcommand, which all ranks run together and end by JobFailed or well.
void add_render(CLI::App& app, const World& world);
void add_intersect(CLI::App& app, const World& world);
void add_report(CLI::App& app, const World& world);
void add_stress(CLI::App& app, const World& world);

/// What all programs of packtrace-mpi take besides those of packtrace.
struct JobArguments {
    bool allow_mixed = false;
    bool json = false;

    [[nodiscard]] Mixing mixing() const
    {
        return allow_mixed ? Mixing::allowed : Mixing::refused;
    }
};

void add_job_options(CLI::App& command, JobArguments& arguments);

/// The scene, on every rank: rank 0 reads the file, or standard input for -, and sends its text. A
/// name such as "generate random --count 10000000" is made by each rank itself. Throws JobFailed.
[[nodiscard]] Scene shared_scene(const World& world, const std::string& name);

/// Throws JobFailed where ranks may not work on one result.
void check_ranks(const World& world, const RenderOptions& options, Mixing mixing);

/// Throws JobFailed where ranks are of unequal versions, or run other instruction sets: rows of
/// studies would differ. No names are all that run on this machine.
void check_same_isas(const World& world, std::vector<std::string> isas);

/// One line on standard error, or with `--json` an object on standard output. `what` names the
/// pieces. Called by all ranks together; rank 0 prints.
void print_report(const World& world, const JobArguments& arguments, bool quiet,
                  const std::string& output, const std::string& what,
                  const std::vector<RankReport>& reports, double seconds);

}  // namespace packtrace::mpi
