#include <algorithm>
#include <charconv>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include <packtrace/write_scene.hpp>

#include "cli/command.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/distinct_files.hpp"
#include "cli/output/output.hpp"
#include "cli/output/text_table.hpp"
#include "cli/study/bench_file.hpp"
#include "cli/study/bench_programs.hpp"
#include "core/atomic_file.hpp"
#include "core/check_number.hpp"
#include "core/checksum.hpp"
#include "lab/bench/paired_bench.hpp"
#include "lab/bench/slowdown.hpp"
#include "scene/language/numbers.hpp"
#include "scene/language/quote.hpp"

namespace packtrace::cli {
namespace {

// How often a line is measured again that seems slower, or of which nothing can be told.
constexpr int confirmations = 2;

struct BenchArguments {
    std::vector<std::string> scenes;
    PictureArguments picture{.size = "256x256", .depth = {}, .min_weight = {}};
    std::optional<std::string> isa;
    int repetitions = 9;
    std::string output;
    std::string baseline;
    std::string against;
    std::optional<std::string> max_slowdown;
};

// The number of "10%" or "0.1"; none when it is something else.
std::optional<double> parse_share(const std::string& text)
{
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    const std::string_view unit(rest, static_cast<std::size_t>(end - rest));
    if (error != std::errc{} || !(value >= 0.0) || value > 1e6 || (unit != "" && unit != "%"))
        return std::nullopt;
    return unit == "%" ? value / 100.0 : value;
}

std::string check_share(const std::string& text)
{
    return parse_share(text) ? "" : "'" + text + "' is not a share such as 10% or 0.1";
}

// What was measured, and what it is compared with.
struct BenchResult {
    BenchPairs figures;
    bool paired = false;
    double limit = 0.0;

    // None for a line that the baseline lacks.
    [[nodiscard]] std::optional<Slowdown> slowdown(const BenchLine& line) const
    {
        const BenchLine* before = figures.before.find(line.name);
        if (before == nullptr)
            return std::nullopt;
        return paired ? paired_slowdown(line.ratios, before->ratios)
                      : unpaired_slowdown(line.ratios, before->ratios);
    }
    [[nodiscard]] std::optional<Verdict> verdict(const BenchLine& line) const
    {
        const std::optional<Slowdown> found = slowdown(line);
        return found ? std::optional(verdict_of(*found, limit)) : std::nullopt;
    }
    // A busy spell passes, a regression stays.
    [[nodiscard]] bool is_doubtful(const BenchLine& line) const
    {
        const std::optional<Verdict> found = verdict(line);
        return found && *found != Verdict::not_slower;
    }
    [[nodiscard]] bool has_doubts() const
    {
        for (const BenchLine& line : figures.now.lines)
            if (is_doubtful(line))
                return true;
        return false;
    }
};

// This program's figures, beside those of a file where there is one.
void measure_alone(const std::vector<ReportScene>& scenes, const BenchArguments& arguments,
                   BenchResult& result)
{
    // Measured here are processor seconds, of which other threads should take none.
    limit_threads(1);
    std::vector<std::string> isas;
    if (arguments.isa)
        isas = {*arguments.isa};
    for (const ReportScene& scene : scenes) {
        SceneBench bench(scene, isas);
        bench.measure(arguments.repetitions, [](const BenchLine&) { return true; });
        for (int i = 0; i < confirmations; ++i)
            bench.measure(arguments.repetitions,
                          [&](const BenchLine& line) { return result.is_doubtful(line); });
        result.figures.now.references.push_back(bench.reference());
        for (const BenchLine& line : bench.lines())
            result.figures.now.lines.push_back(line);
    }
}

// The words of a command line that measures the same.
std::vector<std::string> bench_words(const BenchArguments& arguments)
{
    std::vector<std::string> words{"--size", *arguments.picture.size};
    if (arguments.picture.depth)
        words.insert(words.end(), {"--depth", std::to_string(*arguments.picture.depth)});
    if (arguments.picture.min_weight)
        words.insert(words.end(),
                     {"--min-weight", language::to_text(*arguments.picture.min_weight)});
    if (arguments.isa)
        words.insert(words.end(), {"--isa", *arguments.isa});
    words.emplace_back("--");
    words.insert(words.end(), arguments.scenes.begin(), arguments.scenes.end());
    return words;
}

void measure_in_pairs(const BenchArguments& arguments, BenchResult& result)
{
    result.paired = true;
    for (int i = 0; i == 0 || (i <= confirmations && result.has_doubts()); ++i) {
        const BenchPairs more =
            run_in_pairs(arguments.against, bench_words(arguments), arguments.repetitions);
        result.figures.now.add(more.now);
        result.figures.before.add(more.before);
    }
}

std::string signed_percent(double share)
{
    return (share < 0.0 ? "" : "+") + fixed(100.0 * share, 1) + " %";
}

std::string interval_text(const Slowdown& slowdown)
{
    if (!slowdown.interval)
        return "too few repetitions";
    return signed_percent(slowdown.interval->low) + " to " +
           signed_percent(slowdown.interval->high);
}

const char* verdict_text(Verdict verdict)
{
    switch (verdict) {
        case Verdict::not_slower:
            return "no";
        case Verdict::slower:
            return "yes";
        case Verdict::cannot_tell:
            break;
    }
    return "can't tell";
}

void print_bench_lines(const BenchResult& result)
{
    TextTable table(1, {"run", "ms", "of scalar single", "spread", "baseline", "slowdown",
                        "99 % interval", "slower"});
    const BenchFigures& now = result.figures.now;
    for (const BenchLine& reference : now.references)
        table.add({reference.name + " (the reference)",
                   fixed(1e3 * median_of(reference.seconds), 3), "1",
                   percent(relative_spread(reference.seconds), 1.0), "-", "-", "-", "-"});
    for (const BenchLine& line : now.lines) {
        std::vector<std::string> row{line.name, fixed(1e3 * median_of(line.seconds), 3),
                                     fixed(line.ratio(), 4),
                                     percent(relative_spread(line.ratios), 1.0)};
        if (const std::optional<Slowdown> slowdown = result.slowdown(line))
            row.insert(row.end(), {fixed(result.figures.before.find(line.name)->ratio(), 4),
                                   signed_percent(slowdown->estimate), interval_text(*slowdown),
                                   verdict_text(verdict_of(*slowdown, result.limit))});
        else
            row.insert(row.end(), {"-", "-", "-", "-"});
        table.add(row);
    }
    table.print(std::cout);
}

// Names the lines of one verdict, and says whether there are any.
bool name_lines(const BenchResult& result, Verdict wanted, const std::string& what)
{
    bool any = false;
    for (const BenchLine& line : result.figures.now.lines)
        if (result.verdict(line) == wanted) {
            any = true;
            std::cerr << what << line.name << ": " << interval_text(*result.slowdown(line))
                      << " against the baseline, with " << line.ratios.size() << " repetitions and "
                      << result.figures.before.find(line.name)->ratios.size()
                      << " of the baseline\n";
        }
    return any;
}

void check_compared(const BenchResult& result, const std::string& baseline)
{
    for (const BenchLine& line : result.figures.now.lines)
        if (result.slowdown(line))
            return;
    throw std::runtime_error(baseline + ": has no line of what was measured; give the same scenes");
}

void end_with_verdict(const BenchResult& result)
{
    const bool slower = name_lines(result, Verdict::slower, "slower: ");
    const bool unsure = name_lines(result, Verdict::cannot_tell, "can't tell: ");
    if (unsure)
        std::cerr << "more --repetitions, of the baseline too, or an idler machine would tell\n";
    if (slower || unsure)
        throw Failed{slower ? exit_failed : exit_unsure};
}

// What of a picture times hang on, beside its scene.
std::string picture_text(const PictureArguments& picture)
{
    const auto given = [](const auto& value) {
        return value ? language::to_text(static_cast<double>(*value)) : "the scene's";
    };
    return *picture.size + ", depth " + given(picture.depth) + ", min_weight " +
           given(picture.min_weight);
}

// Earlier versions did not write it.
void check_same_picture(const BenchFigures& now, const BenchFigures& before,
                        const std::string& baseline)
{
    if (!before.picture.empty() && before.picture != now.picture)
        throw std::runtime_error(baseline + ": is of pictures of " + before.picture + ", not of " +
                                 now.picture + "; give the same options");
}

// Earlier versions did not write it.
void check_same_scenes(const BenchFigures& now, const BenchFigures& before,
                       const std::string& baseline)
{
    for (const auto& [name, checksum] : now.scenes)
        if (const auto other = before.scenes.find(name);
            other != before.scenes.end() && other->second != checksum)
            throw std::runtime_error(baseline + ": its " + name +
                                     " is another scene; measure this one's baseline");
}

// Before they are measured.
void check_any_compared(const std::vector<ReportScene>& scenes, const BenchFigures& before,
                        const std::string& baseline)
{
    const auto is_measured = [&](const BenchLine& line) {
        return std::any_of(scenes.begin(), scenes.end(), [&](const ReportScene& scene) {
            return line.name.starts_with(scene.name + ", ");
        });
    };
    if (std::none_of(before.lines.begin(), before.lines.end(), is_measured))
        throw std::runtime_error(baseline +
                                 ": has no line of these scenes; give the same scenes");
}

// Every run of a program reads the scenes anew.
void check_files(const BenchArguments& arguments)
{
    for (const std::string& file : arguments.scenes)
        if (file == "-" && !arguments.against.empty())
            throw CLI::ValidationError(
                "--against: each run reads the scenes, and standard input can be read once only; "
                "give files");
}

void run_bench_command(const BenchArguments& arguments)
{
    check_files(arguments);
    if (arguments.isa)
        (void)chosen_isa({arguments.isa, {}});
    BenchResult result;
    result.limit = *parse_share(arguments.max_slowdown.value_or("10%"));
    if (arguments.max_slowdown && arguments.baseline.empty() && arguments.against.empty())
        throw CLI::ValidationError(
            "--max-slowdown: nothing is compared; give --baseline or --against");
    // Before the work, so that a wrong name doesn't cost it.
    if (!arguments.output.empty()) {
        std::vector<std::string> inputs = arguments.scenes;
        inputs.insert(inputs.end(), {arguments.baseline, arguments.against});
        check_not_read(arguments.output, inputs);
        check_writable(arguments.output);
    }
    result.figures.now.picture = picture_text(arguments.picture);
    if (!arguments.baseline.empty()) {
        result.figures.before = read_bench_file(arguments.baseline);
        check_same_picture(result.figures.now, result.figures.before, arguments.baseline);
    }
    std::vector<ReportScene> scenes;
    std::set<std::string> names;
    for (const std::string& file : arguments.scenes) {
        SceneInput input = read_scene_input(file);
        const std::string name = free_scene_name(language::escape(input.stem), names);
        result.figures.now.scenes[name] = text_hash_digits(scene_text(input.scene));
        scenes.push_back({name, std::move(input.scene)});
        apply(arguments.picture, scenes.back().scene);
    }
    if (!arguments.baseline.empty()) {
        check_any_compared(scenes, result.figures.before, arguments.baseline);
        check_same_scenes(result.figures.now, result.figures.before, arguments.baseline);
    }
    if (arguments.against.empty())
        measure_alone(scenes, arguments, result);
    else
        measure_in_pairs(arguments, result);
    print_bench_lines(result);
    if (!arguments.output.empty()) {
        Output output(arguments.output);
        output.write(bench_text(result.figures.now));
        output.finish();
    }
    const std::string baseline = arguments.baseline + arguments.against;
    if (baseline.empty())
        return;
    check_compared(result, baseline);
    end_with_verdict(result);
}

void add_comparing_options(CLI::App& command, BenchArguments& arguments)
{
    CLI::Option* const baseline =
        command
            .add_option("--baseline", arguments.baseline,
                        "Baseline JSON from an earlier -o; exits 1 if any line is slower, 3 if "
                        "the measurements cannot tell")
            ->type_name("FILE");
    command
        .add_option("--against", arguments.against,
                    "Compare with another packtrace program, timed in turns with this one; "
                    "exits as with --baseline")
        ->excludes(baseline)
        ->type_name("PROGRAM");
    command
        .add_option("--max-slowdown", arguments.max_slowdown,
                    "By how much a line may be slower than the baseline (default 10%)")
        ->check(CLI::Validator(check_share, ""))
        ->type_name("SHARE");
}

}  // namespace

void add_bench(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "bench", "Time kernels against the scalar reference; compare with a baseline");
    const auto arguments = std::make_shared<BenchArguments>();
    command->add_option("SCENE", arguments->scenes, "Scene files; - is standard input")
        ->required()
        ->check(file_name())
        ->type_name("");
    add_picture_options(*command, arguments->picture);
    add_isa_option(*command, arguments->isa, "Only this instruction set (default all there are)");
    command
        ->add_option(
            "--repetitions", arguments->repetitions,
            "Measurements of each line (default 9; fewer may be too few to detect a slowdown)")
        ->check(whole_number(1, most_repetitions))
        ->type_name("N");
    command
        ->add_option("-o,--output", arguments->output,
                     "Write the results as JSON, which later runs can take as --baseline")
        ->check(own_file_name())
        ->type_name("FILE");
    add_comparing_options(*command, *arguments);
    command->callback([arguments] { run_bench_command(*arguments); });
}

}  // namespace packtrace::cli
