#include <charconv>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/common_options.hpp"
#include "cli/scene_input.hpp"
#include "cli/text_output.hpp"
#include "cli/text_table.hpp"
#include "cli/validators.hpp"
#include "core/read_file.hpp"
#include "study/machine.hpp"
#include "study/paired_bench.hpp"

namespace packtrace::cli {
namespace {

using Json = nlohmann::ordered_json;

// How often a line that seems slower is measured again before it is believed.
constexpr int confirmations = 2;

struct BenchArguments {
    std::vector<std::string> scenes;
    PictureArguments picture{.size = "256x256", .depth = {}};
    std::optional<std::string> isa;
    int repetitions = 9;
    std::string output;
    std::string baseline;
    std::string max_slowdown = "10%";
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

std::vector<BaselineLine> read_baseline(const std::string& file)
{
    const Json json = Json::parse(read_file(file), nullptr, false);
    const std::string wrong = file + ": not a file that packtrace bench -o writes";
    if (!json.is_object() || json.value("packtrace_bench", Json()) != 1 ||
        !json.contains("lines") || !json["lines"].is_array())
        throw std::runtime_error(wrong);
    std::vector<BaselineLine> lines;
    for (const Json& line : json["lines"]) {
        if (!line.is_object() || !line.contains("name") || !line["name"].is_string() ||
            !line.contains("ratio") || !line["ratio"].is_number() || !(line["ratio"] > 0.0))
            throw std::runtime_error(wrong);
        lines.push_back({line["name"], line["ratio"]});
    }
    return lines;
}

const BaselineLine* find_line(const std::vector<BaselineLine>& lines, const std::string& name)
{
    for (const BaselineLine& line : lines)
        if (line.name == name)
            return &line;
    return nullptr;
}

Json bench_json(const std::vector<BenchLine>& lines)
{
    Json json{{"packtrace_bench", 1},
              {"conditions",
               {{"processor", processor_name()},
                {"compiler", compiler_name()},
                {"commit", commit_name()}}},
              {"lines", Json::array()}};
    for (const BenchLine& line : lines)
        json["lines"].push_back({{"name", line.name},
                                 {"ratio", line.ratio},
                                 {"spread", line.spread},
                                 {"milliseconds", line.milliseconds},
                                 {"ratios", line.ratios}});
    return json;
}

// A scene's lines and how they stand to the baseline.
struct BenchResult {
    std::vector<BenchLine> lines;
    std::vector<std::string> regressed;
    int compared = 0;
};

// Measures a line that seems slower again: a busy moment passes, a regression stays.
bool is_slower(const ReportScene& scene, const BenchOptions& options, const BaselineLine& baseline,
               double allowed, BenchLine& line)
{
    for (int i = 0; i < confirmations && slowdown(line, baseline) > allowed; ++i)
        repeat_line(scene, options, line);
    return slowdown(line, baseline) > allowed;
}

std::string regression_text(const BenchLine& line, const BaselineLine& baseline)
{
    return "slower: " + line.name + ": " + fixed(100.0 * slowdown(line, baseline), 1) +
           " % over the baseline (" + fixed(line.ratio, 4) + " of the scalar time, was " +
           fixed(baseline.ratio, 4) + ")";
}

void bench_scene(const ReportScene& scene, const BenchArguments& arguments,
                 const std::vector<BaselineLine>& baseline, BenchResult& result)
{
    BenchOptions options;
    options.repetitions = arguments.repetitions;
    if (arguments.isa)
        options.isas = {*arguments.isa};
    const double allowed = *parse_share(arguments.max_slowdown);
    for (BenchLine& line : run_bench(scene, options)) {
        if (const BaselineLine* old = find_line(baseline, line.name)) {
            ++result.compared;
            if (is_slower(scene, options, *old, allowed, line))
                result.regressed.push_back(regression_text(line, *old));
        }
        result.lines.push_back(line);
    }
}

void print_lines(const BenchResult& result, const std::vector<BaselineLine>& baseline)
{
    TextTable table(1, {"run", "ms", "of scalar single", "spread", "baseline", "slowdown"});
    for (const BenchLine& line : result.lines) {
        const BaselineLine* old = find_line(baseline, line.name);
        table.add({line.name, fixed(line.milliseconds, 3), fixed(line.ratio, 4),
                   fixed(100.0 * line.spread, 1) + " %", old ? fixed(old->ratio, 4) : "-",
                   old ? fixed(100.0 * slowdown(line, *old), 1) + " %" : "-"});
    }
    table.print(std::cout);
}

void run_bench_command(const BenchArguments& arguments)
{
    if (arguments.isa)
        (void)chosen_isa({arguments.isa, {}});
    std::vector<BaselineLine> baseline;
    if (!arguments.baseline.empty())
        baseline = read_baseline(arguments.baseline);
    std::vector<ReportScene> scenes;
    for (const std::string& file : arguments.scenes) {
        SceneInput input = read_scene_input(file);
        scenes.push_back({input.stem, {}, std::move(input.scene)});
        apply(arguments.picture, scenes.back().scene);
    }
    BenchResult result;
    for (const ReportScene& scene : scenes)
        bench_scene(scene, arguments, baseline, result);
    print_lines(result, baseline);
    if (!arguments.output.empty()) {
        TextOutput output(arguments.output);
        output.write(bench_json(result.lines).dump(2) + "\n");
        output.finish();
    }
    if (!arguments.baseline.empty() && result.compared == 0)
        throw std::runtime_error(arguments.baseline +
                                 ": has no line of what was measured; give the same scenes");
    for (const std::string& line : result.regressed)
        std::cerr << line << '\n';
    if (!result.regressed.empty())
        throw Failed{};
}

}  // namespace

void add_bench(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "bench", "Time kernels against the scalar reference; compare with a baseline");
    const auto arguments = std::make_shared<BenchArguments>();
    command->add_option("SCENE", arguments->scenes, "Scene files; - is standard input")
        ->required()
        ->type_name("");
    add_picture_options(*command, arguments->picture);
    command
        ->add_option("--isa", arguments->isa, "Only this instruction set (default all there are)")
        ->type_name("NAME");
    command
        ->add_option("--repetitions", arguments->repetitions,
                     "Measurements of each line (default 9)")
        ->check(whole_number(1, 1000))
        ->type_name("N");
    command->add_option("-o,--output", arguments->output, "JSON to write, a later run's baseline")
        ->type_name("FILE");
    command
        ->add_option("--baseline", arguments->baseline,
                     "What -o wrote before; exit 1 when a line is slower")
        ->type_name("FILE");
    command
        ->add_option("--max-slowdown", arguments->max_slowdown,
                     "By how much a line may be slower than the baseline (default 10%)")
        ->check(CLI::Validator(check_share, ""))
        ->type_name("SHARE");
    command->callback([arguments] { run_bench_command(*arguments); });
}

}  // namespace packtrace::cli
