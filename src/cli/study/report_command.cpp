#include "cli/study/report_command.hpp"

#include "cli/command.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/progress_bar.hpp"
#include "cli/study/report_files.hpp"
#include "core/atomic_file.hpp"
#include "core/check_number.hpp"
#include "lab/harness/machine.hpp"
#include "lab/report/plot.hpp"
#include "lab/report/report_text.hpp"
#include "render/check_options.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/write_report.hpp>

#include <tbb/info.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

namespace packtrace::cli {
namespace {

/// The cache folder by the XDG Base Directory Specification, which ignores relative folders.
std::filesystem::path default_cache()
{
    const auto folder_of = [](const char* variable) {
        const char* const value = std::getenv(variable);
        const std::filesystem::path folder = value == nullptr ? "" : value;
        return folder.is_absolute() ? folder : std::filesystem::path();
    };
    if (const std::filesystem::path caches = folder_of("XDG_CACHE_HOME"); !caches.empty())
        return caches / "packtrace";
    if (const std::filesystem::path home = folder_of("HOME"); !home.empty())
        return home / ".cache" / "packtrace";
    return {};
}

/// Why no file can be written into the cache folder, which is created; empty if files can, or if no
/// folder is given. The folder is not removed again, because several ranks may check at once.
std::string fault_of(const std::filesystem::path& cache)
{
    try {
        if (!cache.empty()) {
            make_folders(cache);
            check_writable(cache / ".packtrace");
        }
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

/// Reads the numbers of a text such as 1,2,4. Not set for other text.
std::optional<std::vector<int>> parse_thread_counts(std::string_view text)
{
    std::optional<std::vector<int>> counts = parse_numbers(text, ',');
    const auto is_possible = [](int count) { return count >= 1 && count <= most_threads; };
    if (counts && !std::all_of(counts->begin(), counts->end(), is_possible))
        return std::nullopt;
    return counts;
}

void add_measure_options(CLI::App& command, ReportArguments& arguments)
{
    command
        .add_option("--repetitions", arguments.repetitions, "Frames timed for each run (default 9)")
        ->check(whole_number(1, most_repetitions))
        ->type_name("N");
    command
        .add_option("--truth-spp", arguments.truth_samples,
                    "Samples a pixel of the truth where samples are studied (default 256)")
        ->check(whole_number(2, most_samples))
        ->type_name("N");
    add_threshold_option(command, arguments.options.threshold);
    command
        .add_option_function<std::string>(
            "--threads",
            [&threads = arguments.options.threads](const std::string& text) {
                threads = *parse_thread_counts(text);
            },
            "Numbers of threads (default 1,2)")
        ->check(parsed_by(parse_thread_counts, "whole numbers from 1 to " +
                                                   std::to_string(most_threads) +
                                                   " with commas between them"))
        ->type_name("N[,N…]");
    command
        .add_option(
            "--cache", arguments.cache,
            "Folder in which reference pictures are kept (default packtrace in the user's cache)")
        ->check(folder_name())
        ->type_name("DIR");
}

// Quotes a word of a command line for a shell.
std::string quoted(const std::string& word)
{
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,:=+%@";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos)
        return word;
    return "'" + replaced(word, '\'', "'\\''") + "'";
}

// Removes duplicates, because two runs with one number would have one name.
std::vector<int> each_once(const std::vector<int>& numbers)
{
    std::vector<int> once;
    for (const int number : numbers)
        if (std::find(once.begin(), once.end(), number) == once.end())
            once.push_back(number);
    return once;
}

}  // namespace

void add_report_options(CLI::App& command, ReportArguments& arguments)
{
    command.add_option("SCENE", arguments.scenes, "Scene files; - is standard input")
        ->required()
        ->check(file_name())
        ->type_name("");
    command.add_option("-o,--output", arguments.folder, "Folder for the report")
        ->required()
        ->check(folder_name())
        ->type_name("DIR");
    add_picture_options(command, arguments.picture);
    add_measure_options(command, arguments);
    add_fraction_option(command, "--max-error", arguments.options.max_error,
                        "Name the fastest run whose RMSE is at most E, a number or a fraction N/M "
                        "(default 0.001)")
        ->check(positive_fraction())
        ->type_name("E");
    command
        .add_option("--max-time", arguments.max_time_ms,
                    "Name the most exact run that takes at most MS milliseconds (default 20)")
        ->check(positive_number())
        ->type_name("MS");
    command.add_flag("--quick", arguments.quick,
                     "Fewer runs: the widest packets, 3 repetitions, up to 16 samples");
    command.add_flag("-q,--quiet", arguments.quiet, "No progress bar");
}

std::string report_command(const std::string& program, const CLI::App& command,
                           const ReportArguments& arguments)
{
    std::string typed = program + " " + command.get_name();
    for (const std::string& scene : arguments.scenes)
        typed += " " + quoted(scene);
    typed += " -o " + quoted(arguments.folder.string());
    for (const CLI::Option* option : command.get_options())
        if (option->count() > 0 && !option->get_lnames().empty() &&
            option->get_lnames().front() != "output") {
            typed += " --" + option->get_lnames().front();
            if (option->get_items_expected_max() > 0)
                for (const std::string& word : option->results())
                    typed += " " + quoted(word);
        }
    return language::escape(typed);
}

ReportOptions report_options(const ReportArguments& arguments)
{
    ReportOptions options = arguments.options;
    if (arguments.quick) {
        options.repetitions = 3;
        options.truth_samples = 64;
        options.min_weights = {0.03, 0.002, 0.0};
        options.samples = {1, 4, 16};
        options.adaptive = {{16, 0.02}};
        options.isas = {choose_isa().name};
    }
    options.repetitions = arguments.repetitions.value_or(options.repetitions);
    options.truth_samples = arguments.truth_samples.value_or(options.truth_samples);
    options.cache = arguments.cache ? std::filesystem::path(*arguments.cache) : default_cache();
    if (!arguments.cache && !fault_of(options.cache).empty())
        options.cache.clear();
    options.max_time = 1e-3 * arguments.max_time_ms;
    options.threads = each_once(options.threads);
    return options;
}

void check_report_target(const ReportArguments& arguments)
{
    check_plots();
    if (arguments.cache)
        check_folder(*arguments.cache);
    else if (const std::string fault = fault_of(default_cache()); !fault.empty())
        std::cerr << "warning: " << language::escape(fault)
                  << "; reference pictures are not kept; name a folder for them with --cache\n";
    check_folder(arguments.folder);
    std::error_code ignored;
    if (std::filesystem::exists(arguments.folder, ignored))
        check_writable(arguments.folder / "report.md");
}

int report_threads(const ReportOptions& options)
{
    return std::max(tbb::info::default_concurrency(),
                    *std::max_element(options.threads.begin(), options.threads.end()));
}

void print_judgement(const SceneReport& scene, const ReportOptions& options)
{
    for (const StudyReport& study : scene.studies)
        for (const std::string& line : judgement(study, options))
            std::cout << scene.name << ", " << name_of(study.study) << ": " << line << '\n';
}

void write_whole_report(const std::vector<SceneReport>& reports, const ReportOptions& options,
                        const ReportArguments& arguments)
{
    const ReportConditions conditions{processor_name(),  tbb::info::default_concurrency(),
                                      compiler_name(),   built_commit,
                                      arguments.command, kernel_flags,
                                      load_at_start(),   load_now()};
    ReportFiles files(reports, arguments.folder);
    write_report(reports, options, conditions, arguments.folder);
    files.keep();
}

namespace {

std::vector<ReportScene> read_scenes(const ReportArguments& arguments)
{
    std::vector<ReportScene> scenes;
    std::set<std::string> taken;
    for (const std::string& file : arguments.scenes) {
        SceneInput input = read_scene_input(file);
        ReportScene scene{free_scene_name(report_folder_name(input.stem), taken),
                          std::move(input.scene)};
        apply(arguments.picture, scene.scene);
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

// Shows a progress bar for each step of the work.
class StepBar {
public:
    explicit StepBar(Verbosity verbosity) : verbosity_(verbosity)
    {
    }
    void update(const std::string& step, double share)
    {
        const std::lock_guard lock(mutex_);
        if (step != step_) {
            bar_.reset();
            bar_ = std::make_unique<ProgressBar>(verbosity_);
            step_ = step;
        }
        bar_->update(share);
    }

private:
    Verbosity verbosity_;
    std::mutex mutex_;
    std::string step_;
    std::unique_ptr<ProgressBar> bar_;
};

SceneReport report_scene(const ReportScene& scene, ReportOptions options,
                         const ReportArguments& arguments)
{
    StepBar bar(arguments.quiet ? Verbosity::quiet : Verbosity::normal);
    options.progress = [&bar](const std::string& step, double share) { bar.update(step, share); };
    return report(scene, options);
}

void run_report(const ReportArguments& arguments)
{
    const ReportOptions options = report_options(arguments);
    const std::vector<ReportScene> scenes = read_scenes(arguments);
    // Check before the work, so that a wrong name costs no time.
    check_report_target(arguments);
    // The runs use arenas of different sizes.
    limit_threads(report_threads(options));
    std::vector<SceneReport> reports;
    for (const ReportScene& scene : scenes) {
        reports.push_back(report_scene(scene, options, arguments));
        print_judgement(reports.back(), options);
    }
    write_whole_report(reports, options, arguments);
}

}  // namespace

void add_report(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "report", "Render scenes in many ways; report each way's error against its run time");
    const auto arguments = std::make_shared<ReportArguments>();
    add_report_options(*command, *arguments);
    command->callback([arguments, command] {
        arguments->command = report_command("packtrace", *command, *arguments);
        run_report(*arguments);
    });
}

}  // namespace packtrace::cli
