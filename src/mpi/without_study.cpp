#include "cli/without_study.hpp"

#include "mpi/commands.hpp"

#include <stdexcept>
#include <string>

// Replaces the commands of src/mpi/study in builds without PACKTRACE_BUILD_STUDY.
namespace packtrace::mpi {
namespace {

void leave_out(CLI::App& app, const World& world, const std::string& name)
{
    cli::add_left_out(app, name, [name, &world] {
        world.together([&] { throw std::runtime_error(cli::why_left_out("packtrace-mpi", name)); });
    });
}

}  // namespace

void add_report(CLI::App& app, const World& world)
{
    leave_out(app, world, "report");
}

void add_stress(CLI::App& app, const World& world)
{
    leave_out(app, world, "stress");
}

}  // namespace packtrace::mpi
