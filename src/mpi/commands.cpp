#include "mpi/commands.hpp"

#include "cli/command.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/usage_error.hpp"
#include "core/json_text.hpp"
#include "core/text.hpp"
#include "scene/language/quote.hpp"
#include "scene/language/source.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/version.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace packtrace::mpi {
namespace {

constexpr std::string_view generate_word = "generate ";

Scene generate(const std::string& words)
{
    CLI::App app("", "packtrace");
    Scene made;
    CLI::App* generators = app.add_subcommand("generate", "");
    cli::add_generators(*generators, [&](Scene scene) { made = std::move(scene); });
    app.require_subcommand(1);
    const std::vector<std::string> list = CLI::detail::split_up(words);
    std::vector<const char*> arguments{"packtrace"};
    for (const std::string& word : list)
        arguments.push_back(word.c_str());
    const auto count = static_cast<int>(arguments.size());
    try {
        app.parse(count, arguments.data());
    } catch (const CLI::Success&) {
        throw std::runtime_error(
            "SCENE: " + language::quote(words) +
            " asks for help in place of a scene; see packtrace generate --help");
    } catch (const CLI::ParseError& error) {
        throw std::runtime_error("SCENE: " + cli::usage_error(app, error, count, arguments.data()));
    }
    return made;
}

nlohmann::ordered_json json_of(const JobReport& report, const std::vector<std::string>& hosts)
{
    nlohmann::ordered_json json{
        {"output", report.output}, {"seconds", report.seconds}, {"pieces", report.pieces}};
    json["ranks"] = nlohmann::ordered_json::array();
    for (std::size_t rank = 0; rank < report.ranks.size(); ++rank) {
        const RankReport& one = report.ranks[rank];
        json["ranks"].push_back({{"rank", rank},
                                 {"host", hosts[rank]},
                                 {"pieces", one.pieces},
                                 {"rays", one.rays},
                                 {"busy_seconds", one.busy},
                                 {"waiting_seconds", one.waiting},
                                 {"bytes_sent", one.bytes_sent}});
    }
    return json;
}

void print_line(const JobReport& report)
{
    std::int64_t pieces = 0;
    double waiting = 0.0;
    for (const RankReport& one : report.ranks) {
        pieces += one.pieces;
        waiting = std::max(waiting, one.waiting);
    }
    char times[96];
    std::snprintf(times, sizeof times, " in %.1f s; no rank waited longer than %.1f s\n",
                  report.seconds, waiting);
    std::cerr << language::escape(report.output) << ": " << pieces << ' ' << report.pieces << " on "
              << report.ranks.size() << " ranks" << times;
}

}  // namespace

void add_job_options(CLI::App& command, JobArguments& arguments)
{
    command.add_flag("--allow-mixed", arguments.allow_mixed,
                     "Let ranks with and without fused multiply-add work on one result, whose bits "
                     "then depend on who made them");
    command.add_flag("--json", arguments.json,
                     "Print JSON: rays, busy and waiting seconds of each rank");
}

Scene shared_scene(const World& world, const std::string& name)
{
    Scene scene;
    if (name.starts_with(generate_word)) {
        world.together([&] { scene = generate(name); });
        return scene;
    }
    const std::string shown = cli::scene_name(name);
    std::string text;
    world.together([&] {
        if (world.is_first())
            text = name == "-" ? language::load_text(std::cin, shown) : language::load_text(name);
    });
    world.broadcast(text);
    world.together([&] {
        scene = parse_scene(text, shown, [&](const std::string& line) {
            if (world.is_first())
                std::cerr << "warning: " << line << '\n';
        });
    });
    return scene;
}

std::string shared_scene_stem(const std::string& name)
{
    if (!name.starts_with(generate_word))
        return cli::scene_stem(name);
    const std::string words = name.substr(generate_word.size());
    return words.substr(0, words.find(' '));
}

void check_ranks(const World& world, const RenderOptions& options, Mixing mixing)
{
    const RankSetup setup{PACKTRACE_VERSION_STRING,
                          options.kernel == Kernel::scalar || options.isa != "sse42"};
    const std::string why = why_not_together(world.gather(setup.text()), mixing);
    world.together([&] {
        if (!why.empty())
            throw std::runtime_error(why);
    });
}

void check_same_isas(const World& world, std::vector<std::string> isas)
{
    if (isas.empty())
        for (const IsaInfo& isa : list_isas())
            if (isa.supported)
                isas.push_back(isa.name);
    const std::vector<std::string> versions = world.gather(PACKTRACE_VERSION_STRING);
    const std::vector<std::string> all = world.gather(joined(isas));
    world.together([&] {
        std::string why = why_not_together(versions, Mixing::allowed);
        if (why.empty())
            why = why_rows_differ(all);
        if (!why.empty())
            throw std::runtime_error(why);
    });
}

void print_report(const World& world, const JobReport& report)
{
    const std::vector<std::string> hosts = world.gather(world.host());
    if (!world.is_first())
        return;
    if (report.json)
        std::cout << json_text(json_of(report, hosts));
    else if (!report.quiet)
        print_line(report);
}

}  // namespace packtrace::mpi
