#pragma once

#include "mpi/job.hpp"
#include "mpi/rank_setup.hpp"
#include "mpi/world.hpp"
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

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

/// What the files that are made of such a scene are called: by its file, or by its generator.
[[nodiscard]] std::string shared_scene_stem(const std::string& name);

/// Throws JobFailed where ranks may not work on one result.
void check_ranks(const World& world, const RenderOptions& options, Mixing mixing);

/// Throws JobFailed where ranks are of unequal versions, or run other instruction sets: rows of
/// studies would differ. No names are all that run on this machine.
void check_same_isas(const World& world, std::vector<std::string> isas);

/// What a job did, and how to say so.
struct JobReport {
    std::string output;  ///< what it made
    std::string pieces;  ///< what its pieces of work are called
    std::vector<RankReport> ranks = {};
    double seconds = 0.0;
    bool quiet = false;  ///< without the line on standard error
    bool json = false;   ///< in its place, an object on standard output
};

/// Called by all ranks together; rank 0 prints.
void print_report(const World& world, const JobReport& report);

}  // namespace packtrace::mpi
