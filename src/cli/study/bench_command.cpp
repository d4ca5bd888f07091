#include "cli/command.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/distinct_files.hpp"
#include "cli/output/output.hpp"
#include "cli/study/bench_result.hpp"
#include "core/atomic_file.hpp"
#include "core/check_number.hpp"
#include "core/checksum.hpp"
#include "core/text.hpp"
#include "lab/bench/paired_bench.hpp"
#include "scene/language/numbers.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/write_scene.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace packtrace::cli {
namespace {

// How often a line is measured again if it seems slower, or if the measurement is not conclusive.
constexpr int confirmations = 2;

struct BenchArguments {
    std::vector<std::string> scenes;
    PictureArguments picture{.size = "256x256", .depth = {}, .min_weight = {}};
    std::optional<std::string> isa;
    int repetitions = 9;
    std::string output;
    std::string baseline;
    std::string against;
    std::optional<double> max_slowdown;
};

/// Reads "10%" or "0.1". Not set for other text.
std::optional<double> parse_share(std::string_view text)
{
    const bool percent = text.ends_with('%');
    const std::optional<double> value =
        parse_number<double>(text.substr(0, text.size() - (percent ? 1 : 0)));
    if (!value || !(*value >= 0.0) || *value > 1e6)
        return std::nullopt;
    return percent ? *value / 100.0 : *value;
}

// Measures this program, to be compared with a baseline file if there is one.
void measure_alone(const std::vector<ReportScene>& scenes, const BenchArguments& arguments,
                   BenchResult& result)
{
    // CPU seconds are measured, so there should be no other threads.
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

// A command line for the same measurement.
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

// The options of a picture that times depend on, besides the scene.
std::string picture_text(const PictureArguments& picture)
{
    const auto given = [](const auto& value) {
        return value ? language::to_text(static_cast<double>(*value)) : "the scene's";
    };
    return *picture.size + ", depth " + given(picture.depth) + ", min_weight " +
           given(picture.min_weight);
}

// Files of earlier versions do not have the picture.
void check_same_picture(const BenchFigures& now, const BenchFigures& before,
                        const std::string& baseline)
{
    if (!before.picture.empty() && before.picture != now.picture)
        throw std::runtime_error(baseline + ": is of pictures of " + before.picture + ", not of " +
                                 now.picture + "; give the same options");
}

// Files of earlier versions do not have the scenes.
void check_same_scenes(const BenchFigures& now, const BenchFigures& before,
                       const std::string& baseline)
{
    for (const auto& [name, checksum] : now.scenes)
        if (const auto other = before.scenes.find(name);
            other != before.scenes.end() && other->second != checksum)
            throw std::runtime_error(baseline + ": its " + name +
                                     " is another scene; measure this one's baseline");
}

// Call it before the scenes are measured.
void check_any_compared(const std::vector<ReportScene>& scenes, const BenchFigures& before,
                        const std::string& baseline)
{
    const auto is_measured = [&](const BenchLine& line) {
        return std::any_of(scenes.begin(), scenes.end(), [&](const ReportScene& scene) {
            return line.name.starts_with(scene.name + ", ");
        });
    };
    if (std::none_of(before.lines.begin(), before.lines.end(), is_measured))
        throw std::runtime_error(baseline + ": has no line of these scenes; give the same scenes");
}

// Rejects standard input, because every run of a program reads the scenes again.
void check_files(const BenchArguments& arguments)
{
    for (const std::string& file : arguments.scenes)
        if (file == "-" && !arguments.against.empty())
            throw CLI::ValidationError(
                "--against: each run reads the scenes, and standard input can be read once only; "
                "give files");
}

/// Checks before the work, so that a wrong name costs no time.
void check_output(const BenchArguments& arguments)
{
    if (arguments.output.empty())
        return;
    std::vector<std::string> inputs = arguments.scenes;
    inputs.insert(inputs.end(), {arguments.baseline, arguments.against});
    check_not_read(arguments.output, inputs);
    check_writable(arguments.output);
}

/// Checks the options before any work, and throws for the first fault.
void check_bench(const BenchArguments& arguments)
{
    check_files(arguments);
    if (arguments.isa)
        (void)chosen_isa({arguments.isa, {}});
    if (arguments.max_slowdown && arguments.baseline.empty() && arguments.against.empty())
        throw CLI::ValidationError(
            "--max-slowdown: nothing is compared; give --baseline or --against");
    check_output(arguments);
}

/// Reads the scenes, and stores their checksums in `figures`.
std::vector<ReportScene> read_bench_scenes(const BenchArguments& arguments, BenchFigures& figures)
{
    std::vector<ReportScene> scenes;
    std::set<std::string> names;
    for (const std::string& file : arguments.scenes) {
        SceneInput input = read_scene_input(file);
        const std::string name = free_scene_name(language::escape(input.stem), names);
        figures.scenes[name] = text_hash_digits(scene_text(input.scene));
        scenes.push_back({name, std::move(input.scene)});
        apply(arguments.picture, scenes.back().scene);
    }
    return scenes;
}

void write_bench_file(const std::string& file, const BenchFigures& figures)
{
    if (file.empty())
        return;
    Output output(file);
    output.write(bench_text(figures));
    output.finish();
}

void run_bench_command(const BenchArguments& arguments)
{
    check_bench(arguments);
    BenchResult result;
    result.limit = arguments.max_slowdown.value_or(0.1);
    result.figures.now.picture = picture_text(arguments.picture);
    if (!arguments.baseline.empty()) {
        result.figures.before = read_bench_file(arguments.baseline);
        check_same_picture(result.figures.now, result.figures.before, arguments.baseline);
    }
    const std::vector<ReportScene> scenes = read_bench_scenes(arguments, result.figures.now);
    if (!arguments.baseline.empty()) {
        check_any_compared(scenes, result.figures.before, arguments.baseline);
        check_same_scenes(result.figures.now, result.figures.before, arguments.baseline);
    }
    if (arguments.against.empty())
        measure_alone(scenes, arguments, result);
    else
        measure_in_pairs(arguments, result);
    print_bench_lines(result);
    write_bench_file(arguments.output, result.figures.now);
    if (const std::string baseline = arguments.baseline + arguments.against; !baseline.empty())
        end_with_verdict(result, baseline);
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
        .add_option_function<std::string>(
            "--max-slowdown",
            [&limit = arguments.max_slowdown](const std::string& text) {
                limit = parse_share(text);
            },
            "By how much a line may be slower than the baseline (default 10%)")
        ->check(parsed_by(parse_share, "a share such as 10% or 0.1"))
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
