#include "mpi/shared_scene.hpp"

#include <iostream>
#include <stdexcept>
#include <utility>

#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/version.hpp>

#include "cli/commands/generators.hpp"
#include "cli/usage_error.hpp"
#include "scene/source.hpp"

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
    try {
        app.parse(words, false);
    } catch (const CLI::ParseError& error) {
        const char* const none = "";
        throw std::runtime_error("SCENE: " + cli::usage_error(app, error, 1, &none));
    }
    return made;
}

}  // namespace

Scene shared_scene(const World& world, const std::string& name)
{
    Scene scene;
    if (name.starts_with(generate_word)) {
        world.together([&] { scene = generate(name); });
        return scene;
    }
    const std::string shown = name == "-" ? "standard input" : name;
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
    std::string names;
    for (const std::string& isa : isas)
        names += (names.empty() ? "" : ", ") + isa;
    const std::vector<std::string> versions = world.gather(PACKTRACE_VERSION_STRING);
    const std::vector<std::string> all = world.gather(names);
    world.together([&] {
        std::string why = why_not_together(versions, Mixing::allowed);
        if (why.empty())
            why = why_rows_differ(all);
        if (!why.empty())
            throw std::runtime_error(why);
    });
}

}  // namespace packtrace::mpi
