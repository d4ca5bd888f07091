// packtrace-mpi: the work of packtrace on many ranks.
#include "cli/command.hpp"
#include "cli/interrupts.hpp"
#include "cli/output/standard_output.hpp"
#include "cli/usage_error.hpp"
#include "core/atomic_file.hpp"
#include "mpi/commands.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/version.hpp>

#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <string>
#include <unistd.h>
#include <vector>

namespace packtrace::mpi {
namespace {

/// The process of rank 0 if it is on this host, else 0.
volatile pid_t first_process = 0;

/// mpirun of Open MPI kills all ranks of a node with SIGKILL as soon as one has ended after
/// SIGTERM. So each rank waits for this time, to let the others clean up.
constexpr int linger_milliseconds = 300;

/// The message of rank 1 if rank 0 has died.
std::string death_line;

// Calls only functions that signal handlers may call.
void end_quietly(int signal)
{
    // Rank 0 prints the message, unless it has died.
    if (first_process != 0 && kill(first_process, 0) != 0) {
        [[maybe_unused]] const ssize_t written =
            write(STDERR_FILENO, death_line.data(), death_line.size());
    }
    remove_all_temporaries();
    cli::end_by_signal(signal, linger_milliseconds);
}

/// Makes a job that a signal ends print only one message.
void clean_up_when_ended(const World& world)
{
    const std::string advice =
        "finished work is kept where --resume was given, and of --frames: start the same command "
        "again";
    if (world.is_first())
        cli::clean_up_when_interrupted({.program = "packtrace-mpi",
                                        .advice = advice,
                                        .linger_milliseconds = linger_milliseconds});
    const std::string process = std::to_string(getpid());
    const std::vector<std::string> hosts = world.gather(world.host());
    const std::vector<std::string> processes = world.gather(process);
    if (world.is_first())
        return;
    if (world.rank() == 1 && hosts[0] == hosts[1])
        first_process = static_cast<pid_t>(std::stol(processes[0]));
    death_line = "\npacktrace-mpi: rank 0 died; " + advice + "\n";
    cli::handle_ending_signals(end_quietly);
}

/// Prints help, version or a wrong use on rank 0.
int report_parse_end(const World& world, const CLI::App& app, const CLI::ParseError& end, int argc,
                     char** argv)
{
    if (end.get_exit_code() == 0)
        return world.is_first() ? app.exit(end) : cli::exit_ok;
    if (world.is_first())
        std::cerr << language::escape(cli::usage_error(app, end, argc, argv)) << '\n';
    return cli::exit_usage;
}

/// Throws JobFailed if ranks have arguments for different work. A picture would be a mixture, and
/// ranks would wait for each other in different functions.
void check_same_arguments(const World& world, int argc, char** argv)
{
    const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    const std::string why = why_arguments_differ(world.gather(shared_arguments(arguments)));
    world.together([&] {
        if (!why.empty())
            throw CLI::ValidationError(why);
    });
}

/// Runs the subcommand on all ranks.
int parse_and_run(const World& world, CLI::App& app, int argc, char** argv)
{
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& end) {
        return report_parse_end(world, app, end, argc, argv);
    }
    return cli::exit_ok;
}

int run(const World& world, int argc, char** argv)
{
    CLI::App app{"packtrace on many ranks, by MPI; SCENE is a file, - or 'generate NAME OPTION...'",
                 "packtrace-mpi"};
    app.set_version_flag("--version", "packtrace-mpi " PACKTRACE_VERSION_STRING);
    add_render(app, world);
    add_intersect(app, world);
    add_report(app, world);
    add_stress(app, world);
    clean_up_when_ended(world);
    cli::report_size_limits_as_errors();
    cli::ask_for_subcommand(app);
    try {
        check_same_arguments(world, argc, argv);
        const int exit_code = parse_and_run(world, app, argc, argv);
        if (exit_code == cli::exit_ok)
            world.together([&] {
                if (world.is_first())
                    cli::check_standard_output();
            });
        return exit_code;
    } catch (const JobFailed& failed) {
        return failed.exit_code;
    }
}

/// Ends the program after the work. When the first rank ends with an error, mpirun ends the others
/// with a signal, which must not be reported.
int end_together(int exit_code)
{
    for (const int number : cli::ending_signals)
        std::signal(number, SIG_IGN);
    MPI_Barrier(MPI_COMM_WORLD);
    return exit_code;
}

}  // namespace
}  // namespace packtrace::mpi

int main(int argc, char** argv)
{
    packtrace::cli::hold_standard_output();
    const packtrace::mpi::World world(argc, argv);
    try {
        return packtrace::mpi::end_together(packtrace::mpi::run(world, argc, argv));
    } catch (...) {
        packtrace::mpi::abort_job(world, std::current_exception());
    }
}
