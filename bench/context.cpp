#include "context.hpp"

#include <cstdio>

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

std::pair<std::string, std::string> load_after()
{
    return {"load_after", load_text(load_now())};
}

std::string command_line(const std::string& program, int argc, const char* const* argv)
{
    std::string line = program;
    for (int i = 1; i < argc; ++i)
        line += std::string(" ") + argv[i];
    return line;
}

}  // namespace packtrace::bench
