#include "context.hpp"

#include <exception>
#include <iostream>

#include "core/text.hpp"
#include "lab/harness/machine.hpp"
#include "names.hpp"

namespace packtrace::bench {

std::vector<std::pair<std::string, std::string>> context()
{
    return {{"processor", processor_name()}, {"instruction_sets", joined(supported_isas(), " ")},
            {"compiler", compiler_name()},   {"flags", kernel_flags},
            {"commit", built_commit},        {"load_before", fixed(load_at_start(), 2)}};
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
    context["load_after"] = fixed(load_now(), 2);
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
