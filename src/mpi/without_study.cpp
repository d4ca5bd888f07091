#include <stdexcept>
#include <string>

#include "mpi/commands.hpp"

// Stands in for the commands of src/mpi/study in builds without it (PACKTRACE_BUILD_STUDY).
namespace packtrace::mpi {
namespace {

void add_left_out(CLI::App& app, const World& world, const std::string& name)
{
    CLI::App* command = app.add_subcommand(name, "(not in this build; ./run build adds it)");
    command->allow_extras();
    command->callback([name, &world] {
        world.together([&] {
            throw std::runtime_error("packtrace-mpi: this build leaves out '" + name +
                                     "'; type ./run build, which builds all commands");
        });
    });
}

}  // namespace

void add_report(CLI::App& app, const World& world)
{
    add_left_out(app, world, "report");
}

void add_stress(CLI::App& app, const World& world)
{
    add_left_out(app, world, "stress");
}

}  // namespace packtrace::mpi
