#include "cli/interrupts.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/study/stress_command.hpp"
#include "core/seconds_since.hpp"
#include "lab/stress/stress.hpp"
#include "mpi/commands.hpp"
#include "mpi/quiet_node.hpp"
#include "mpi/study/study_wire.hpp"

#include <chrono>
#include <memory>
#include <vector>

namespace packtrace::mpi {
namespace {

using lab::StressOptions;
using lab::StressRow;

std::vector<StressRow> rows_of(const StressOptions& part)
{
    std::vector<StressRow> rows;
    lab::run_stress(part, [&](const std::vector<StressRow>& some) {
        rows.insert(rows.end(), some.begin(), some.end());
    });
    return rows;
}

/// Runs all parts. Returns the rows, on rank 0 only.
std::vector<StressRow> run_parts(const World& world, std::vector<StressOptions> parts,
                                 std::vector<RankReport>& reports)
{
    const QuietNode node;
    for (StressOptions& part : parts)
        part.alone = [&](const std::function<void()>& timed) { node.alone(timed); };
    const auto make = [&](int number, RankReport& report) {
        std::vector<StressRow> rows;
        node.side_by_side([&] { rows = rows_of(parts[static_cast<std::size_t>(number)]); });
        for (const StressRow& row : rows)
            report.rays += row.rays;
        return piece_of(rows);
    };
    std::vector<StressRow> all;
    const int count = static_cast<int>(parts.size());
    Job job(world, count, count);
    reports = job.run(make, [&](const Piece& piece) {
        std::vector<StressRow> rows;
        WireReader wire(piece.bytes);
        wire(rows);
        all.insert(all.end(), rows.begin(), rows.end());
    });
    return all;
}

void run_stress_on_ranks(const World& world, const cli::StressArguments& arguments)
{
    if (arguments.list) {
        if (world.is_first())
            cli::print_stress_families(arguments);
        return;
    }
    const auto start = std::chrono::steady_clock::now();
    std::vector<StressOptions> parts;
    world.together([&] { parts = lab::stress_parts(cli::stress_options(arguments)); });
    check_same_isas(world,
                    arguments.isa ? std::vector{parts.front().isa} : std::vector<std::string>());
    if (world.is_first())
        cli::set_interrupt_line("the job ended before all families were run; start it again");
    cli::limit_threads(arguments.threads, 2);
    std::vector<RankReport> reports;
    const std::vector<StressRow> rows = run_parts(world, std::move(parts), reports);
    cli::set_interrupt_line("");
    world.together([&] {
        if (world.is_first())
            cli::print_stress(arguments, rows);
    });
    print_report(world, {.output = "stress",
                         .pieces = "families in one precision",
                         .ranks = reports,
                         .seconds = seconds_since(start)});
    int failed = lab::without_faults(rows) ? 0 : 1;
    MPI_Bcast(&failed, 1, MPI_INT, 0, MPI_COMM_WORLD);
    if (failed != 0)
        throw JobFailed{};
}

}  // namespace

void add_stress(CLI::App& app, const World& world)
{
    CLI::App* command = app.add_subcommand(
        "stress", "Trace extreme rays, whose hits are known to 113 bits; ranks share the families");
    const auto arguments = std::make_shared<cli::StressArguments>();
    cli::add_stress_options(*command, *arguments);
    command->callback([arguments, command, &world] {
        cli::check_list_options(*command, *arguments);
        run_stress_on_ranks(world, *arguments);
    });
}

}  // namespace packtrace::mpi
