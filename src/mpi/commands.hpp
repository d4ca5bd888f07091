#pragma once

#include <CLI/CLI.hpp>

#include "mpi/world.hpp"

namespace packtrace::mpi {

// Each adds its subcommand, which all ranks run together and end by JobFailed or well.
void add_render(CLI::App& app, const World& world);
void add_intersect(CLI::App& app, const World& world);
void add_report(CLI::App& app, const World& world);
void add_stress(CLI::App& app, const World& world);

}  // namespace packtrace::mpi
