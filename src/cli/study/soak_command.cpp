#include "cli/command.hpp"
#include "cli/interrupts.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/options/validators.hpp"
#include "core/arena.hpp"
#include "core/atomic_file.hpp"
#include "core/text.hpp"
#include "lab/soak/soak.hpp"
#include "lab/stress/evaluate.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/write_scene.hpp>

#include <tbb/info.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace packtrace::cli {
namespace {

constexpr int most_scenes = 1'000'000'000;

struct SoakArguments {
    lab::SoakOptions options;
    std::optional<double> minutes;
    std::optional<int> scenes;
    int first = 0;
    std::filesystem::path cases = ".";
    std::vector<std::string> files;
    int threads = 0;
};

/// Prints the commands that reproduce a finding.
void print_commands(const lab::SoakFinding& finding, const std::string& scene,
                    const std::string& rays)
{
    if (!finding.ray)
        std::cout << "    packtrace soak " << scene << '\n';
    char picture = 'a';
    for (const lab::SoakWay& way : finding.ways) {
        if (finding.ray)
            std::cout << "    packtrace intersect " << scene << ' ' << rays
                      << lab::intersect_words(way) << '\n';
        else
            std::cout << "    packtrace render " << scene << lab::render_words(way) << " -o "
                      << picture++ << ".pfm\n";
    }
    if (finding.ways.size() == 2 && !finding.ray)
        std::cout << "    packtrace compare a.pfm b.pfm\n";
}

void print_report(const SoakArguments& arguments, const lab::SoakReport& report)
{
    const std::string stem =
        "soak-" + std::to_string(arguments.options.seed) + "-" + std::to_string(report.number);
    const std::filesystem::path scene = arguments.cases / (stem + ".scene");
    const std::filesystem::path rays = arguments.cases / (stem + ".csv");
    make_folders(arguments.cases);
    write_file(scene, "# " + report.finding.what + "\n" + scene_text(report.scene));
    if (report.finding.ray)
        write_file(rays, lab::csv_of(*report.finding.ray));
    std::cout << "scene " << report.number << ": " << report.finding.what << '\n';
    print_commands(report.finding, language::escape(scene.string()),
                   language::escape(rays.string()));
    std::cout << std::flush;
}

/// Checks a scene with both rules for self-hits. Returns the first finding.
std::optional<lab::SoakFinding> finding_in(const Scene& scene, const lab::SoakOptions& options)
{
    for (const SelfHits self_hits : {SelfHits::exact, SelfHits::note})
        if (auto finding = lab::check_scene(scene, self_hits, options.seed, options.aligned))
            return finding;
    return std::nullopt;
}

/// Checks scenes from files instead of random ones.
int check_files(const SoakArguments& arguments)
{
    // Read all files before the work, so that a wrong name costs no time.
    std::vector<SceneInput> inputs;
    for (const std::string& file : arguments.files)
        inputs.push_back(read_scene_input(file));
    int findings = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        set_interrupt_line("interrupted after " + std::to_string(i) + " of " +
                           std::to_string(inputs.size()) + " scenes");
        const auto finding = finding_in(inputs[i].scene, arguments.options);
        std::cout << language::escape(inputs[i].name) << ": "
                  << (finding ? finding->what : "as it should be") << '\n'
                  << std::flush;
        if (finding && !finding->ray)
            print_commands(*finding, language::escape(arguments.files[i]), "");
        findings += finding ? 1 : 0;
    }
    set_interrupt_line("");
    return findings;
}

std::string text_of(const lab::SoakCounts& counts)
{
    return counted(static_cast<std::int64_t>(counts.scenes), "scene") + ", " +
           std::to_string(counts.refused) + " of them refused by the scene language, " +
           counted(counts.findings, "finding");
}

int check_random(const SoakArguments& arguments)
{
    lab::SoakOptions options = arguments.options;
    if (arguments.scenes)
        options.scenes = static_cast<std::uint64_t>(*arguments.scenes);
    options.first = static_cast<std::uint64_t>(arguments.first);
    if (arguments.minutes || !arguments.scenes)
        options.seconds = 60.0 * arguments.minutes.value_or(1.0);
    const lab::SoakCounts counts = lab::run_soak(
        options, [&](const lab::SoakReport& report) { print_report(arguments, report); },
        [](const lab::SoakCounts& so_far) {
            set_interrupt_line("interrupted after " + text_of(so_far));
        });
    set_interrupt_line("");
    std::cout << text_of(counts) << '\n';
    return counts.findings;
}

void run(const SoakArguments& arguments)
{
    // Check before the work, so that a wrong name costs no time.
    if (arguments.files.empty())
        check_folder(arguments.cases);
    const int threads =
        arguments.threads > 0 ? arguments.threads : tbb::info::default_concurrency();
    // Some pictures are rendered on several threads, in their own arenas.
    limit_threads(std::max(threads, lab::soak_threads));
    const int findings = run_on_threads(threads, [&] {
        return arguments.files.empty() ? check_random(arguments) : check_files(arguments);
    });
    if (findings > 0)
        throw Failed{};
}

/// The options for the scenes: files, or the number and the kind of random scenes.
void add_scene_options(CLI::App& command, SoakArguments& arguments)
{
    CLI::Option* const files =
        command
            .add_option("SCENE", arguments.files,
                        "Check these scene files in place of random scenes; - is standard input")
            ->check(file_name())
            ->type_name("");
    command
        .add_option("--minutes", arguments.minutes,
                    "Stop after N minutes (default 1; no limit with --scenes)")
        ->excludes(files)
        ->check(positive_number())
        ->type_name("N");
    command.add_option("--scenes", arguments.scenes, "How many scenes to trace at most")
        ->excludes(files)
        ->check(whole_number(1, most_scenes))
        ->type_name("N");
    command
        .add_option("--seed", arguments.options.seed,
                    "Seed of the random scenes, 0 to 2147483647 (default 1)")
        ->check(whole_number(0, std::numeric_limits<int>::max()))
        ->type_name("N");
    command
        .add_option("--first", arguments.first,
                    "Number of the first scene (default 0); a finding names its own")
        ->excludes(files)
        ->check(whole_number(0, most_scenes))
        ->type_name("N");
    command.add_flag(
        "--aligned", arguments.options.aligned,
        "Round the random scenes and rays to a coarse grid and its axes, so that much of them "
        "touches, coincides or runs parallel; answers are held against each other alone");
}

/// The options for findings: how many end the work, and where they are written.
void add_finding_options(CLI::App& command, SoakArguments& arguments)
{
    command
        .add_option("--findings", arguments.options.most_findings,
                    "Stop after so many findings (default 10)")
        ->check(whole_number(1, 1000))
        ->type_name("N");
    command
        .add_option("--cases", arguments.cases,
                    "Write the scenes of findings into this folder (default .)")
        ->check(folder_name())
        ->type_name("FOLDER");
}

}  // namespace

void add_soak(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "soak", "Trace random scenes with every kernel, mode and query, and compare the answers");
    const auto arguments = std::make_shared<SoakArguments>();
    add_scene_options(*command, *arguments);
    add_finding_options(*command, *arguments);
    add_threads_option(*command, arguments->threads);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace packtrace::cli
