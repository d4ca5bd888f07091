#include "cli/study/stress_command.hpp"

#include "cli/command.hpp"
#include "cli/interrupts.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/shard.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/options/validators.hpp"
#include "core/atomic_file.hpp"
#include "core/text.hpp"
#include "lab/stress/stress.hpp"
#include "lab/stress/stress_subject.hpp"
#include "render/precision.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace packtrace::cli {
namespace {

constexpr int most_rays = 10000000;

std::vector<std::string> family_names()
{
    std::vector<std::string> names;
    for (const auto& family : lab::list_stress_families())
        names.push_back(family.name);
    return names;
}

std::vector<std::string> mode_names()
{
    std::vector<std::string> names;
    for (const lab::StressMode& mode : lab::stress_modes)
        names.emplace_back(mode.name);
    return names;
}

}  // namespace

void add_stress_options(CLI::App& command, StressArguments& arguments)
{
    lab::StressOptions& options = arguments.options;
    command.add_option("--family", options.families, "Only this family of rays (repeatable)")
        ->check(one_of_many(family_names(), "a family that --list names"))
        ->type_name("NAME");
    command.add_flag("--list", arguments.list, "List the families; only with --family and --json");
    command.add_option("--rays", options.rays, "Rays of each family (default 4096)")
        ->check(whole_number(1, most_rays))
        ->type_name("N");
    command
        .add_option("--seed", options.seed, "Seed of the random rays, 0 to 2147483647 (default 1)")
        ->check(whole_number(0, std::numeric_limits<int>::max()))
        ->type_name("N");
    add_word_option(command, "--kernel", options.kernels, "Only this kernel (repeatable)",
                    {"packet", "scalar", "textbook"});
    command
        .add_option("--mode", options.modes,
                    "Only this accuracy mode of packets: fast or exact (repeatable)")
        ->check(one_of(mode_names()))
        ->type_name("NAME");
    add_word_option(command, "--precision", arguments.precisions,
                    "Only this precision (repeatable)", words_of(packet_precisions));
    add_isa_option(command, arguments.isa, "Only this instruction set (default all)");
    add_traversal_option(command, arguments.traversal);
    add_word_option(command, "--self-hits", arguments.self_hits,
                    "How secondary rays avoid hitting the surface they start on (default exact)",
                    words_of<SelfHits>());
    add_threads_option(command, arguments.threads);
    command
        .add_option("--cases", arguments.cases,
                    "Write the first wrong ray of each row, and its scene, into this folder")
        ->check(folder_name())
        ->type_name("FOLDER");
    command.add_flag("--json", arguments.json, "Print JSON");
}

void check_list_options(const CLI::App& command, const StressArguments& arguments)
{
    if (!arguments.list)
        return;
    for (const CLI::Option* option : command.get_options())
        if (const std::string name = option->get_name();
            option->count() > 0 && name != "--list" && name != "--family" && name != "--json")
            throw CLI::ValidationError(name + ": --list traces no rays; leave one out");
}

lab::StressOptions stress_options(const StressArguments& arguments)
{
    const auto& kernels = arguments.options.kernels;
    const bool has_packets =
        kernels.empty() || std::find(kernels.begin(), kernels.end(), "packet") != kernels.end();
    if (!has_packets && (arguments.isa || arguments.traversal || !arguments.options.modes.empty()))
        throw CLI::ValidationError(
            "--isa, --mode, --traversal: only packets have them; add --kernel packet or leave "
            "them out");
    lab::StressOptions options = arguments.options;
    for (const std::string& word : arguments.precisions)
        options.precisions.push_back(chosen_precision(word));
    if (!options.modes.empty() && !lab::wanted(options.precisions, Precision::single))
        throw CLI::ValidationError(
            "--mode: only packets of floats have a choice; leave it out or add --precision single");
    if (arguments.isa)
        options.isa = chosen_isa({arguments.isa, {}}).name;
    options.traversal = value_or(arguments.traversal, Traversal::automatic);
    options.self_hits = value_or(arguments.self_hits, options.self_hits);
    return options;
}

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

/// Sets the message for an interruption: how far the run came.
void note_progress(std::size_t done, std::size_t families, const std::vector<StressRow>& rows)
{
    const auto faulty = std::count_if(rows.begin(), rows.end(),
                                      [](const StressRow& row) { return !row.faults.empty(); });
    set_interrupt_line("interrupted after " + std::to_string(done) + " of " +
                       counted(static_cast<std::int64_t>(families), "family", "families") + ", " +
                       std::to_string(faulty) + " of " + std::to_string(rows.size()) +
                       " rows with faults");
}

void run_stress_command(const StressArguments& arguments)
{
    if (arguments.list)
        return print_stress_families(arguments);
    lab::StressOptions options = stress_options(arguments);
    if (arguments.shard)
        take_shard(arguments, options);
    limit_threads(arguments.threads);
    // Check before the work, so that a wrong name costs no time.
    if (arguments.cases)
        check_folder(*arguments.cases);
    const std::size_t families = lab::chosen_families(options).size();
    std::vector<StressRow> rows;
    std::size_t done = 0;
    note_progress(done, families, rows);
    lab::run_stress(options, [&](const std::vector<StressRow>& some) {
        rows.insert(rows.end(), some.begin(), some.end());
        note_progress(++done, families, rows);
    });
    set_interrupt_line("");
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
    command->callback([arguments, command] {
        check_list_options(*command, *arguments);
        run_stress_command(*arguments);
    });
}

}  // namespace packtrace::cli
