#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "mpi/job.hpp"
#include "mpi/rank_setup.hpp"

namespace packtrace::mpi {

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

/// One line on standard error, or with `--json` an object on standard output. `what` names the
/// pieces. Called by all ranks together; rank 0 prints.
void print_report(const World& world, const JobArguments& arguments, bool quiet,
                  const std::string& output, const std::string& what,
                  const std::vector<RankReport>& reports, double seconds);

}  // namespace packtrace::mpi
