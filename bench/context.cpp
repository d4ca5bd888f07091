#include "context.hpp"

#include <cstdio>
#include <exception>
#include <iostream>

#include <packtrace/isa.hpp>

#include "lab/harness/machine.hpp"

namespace packtrace::bench {
namespace {

std::string instruction_sets()
{
    std::string names;
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            names += (names.empty() ? "" : " ") + isa.name;
    return names;
}

std::string load_text(double load)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", load);
    return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> context()
{
    return {{"processor", processor_name()}, {"instruction_sets", instruction_sets()},
            {"compiler", compiler_name()},   {"flags", flags_name()},
            {"commit", commit_name()},       {"load_before", load_text(load_at_start())}};
}

nlohmann::ordered_json context_json()
{
    nlohmann::ordered_json json;
    for (const auto& [name, value] : context())
        json[name] = value;
    return json;
}

void add_load_after(nlohmann::ordered_json& context)
{
    context["load_after"] = load_text(load_now());
}

std::string command_line(const std::string& program, int argc, const char* const* argv)
{
    std::string line = program;
    for (int i = 1; i < argc; ++i)
        line += std::string(" ") + argv[i];
    return line;
}

int run_program(CLI::App& app, const std::string& program, int argc, char** argv,
                const std::function<void()>& work)
{
    try {
        app.parse(argc, argv);
        work();
    } catch (const CLI::ParseError& end) {
        return app.exit(end) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::cerr << program << ": " << error.what() << '\n';
        return 1;
    }
    return 0;
}

}  // namespace packtrace::bench
