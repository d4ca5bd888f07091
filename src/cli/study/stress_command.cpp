#include <memory>
#include <vector>

#include "cli/command.hpp"
#include "cli/options/shard.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/study/stress_output.hpp"
#include "lab/stress/stress_verdict.hpp"

namespace packtrace::cli {
namespace {

using lab::StressRow;

void take_shard(const StressArguments& arguments, lab::StressOptions& options)
{
    if (!arguments.json)
        throw CLI::ValidationError("--shard: packtrace join reads parts as JSON; add --json");
    const Shard shard = *parse_shard(*arguments.shard);
    options.first_family = shard.index;
    options.family_step = shard.count;
}

void run_stress_command(const StressArguments& arguments)
{
    if (arguments.list)
        return print_stress_families();
    lab::StressOptions options = stress_options(arguments);
    if (arguments.shard)
        take_shard(arguments, options);
    const ThreadLimit limit(arguments.threads);
    std::vector<StressRow> rows;
    lab::run_stress(options, [&](const std::vector<StressRow>& some) {
        rows.insert(rows.end(), some.begin(), some.end());
    });
    print_stress(arguments, rows);
    if (!lab::without_faults(rows))
        throw Failed{};
}

}  // namespace

void add_stress(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "stress", "Trace extreme rays, whose hits are known to 113 bits, with every kernel");
    const auto arguments = std::make_shared<StressArguments>();
    add_stress_options(*command, *arguments);
    add_shard_option(
        *command, arguments->shard,
        "Only families I, I + N and so on; packtrace join makes one JSON of the parts");
    command->callback([arguments] { run_stress_command(*arguments); });
}

}  // namespace packtrace::cli
