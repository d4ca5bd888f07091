#include "context.hpp"

#include <cstdio>
#include <fstream>
#include <memory>

#include <packtrace/isa.hpp>

namespace packtrace::bench {
namespace {

std::string processor()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(": ") + 2);
    return "unknown";
}

std::string compiler()
{
#if defined(__clang__)
    return "clang " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

// Asked when the benchmark runs: a commit kept from configuring would be out of date. Results and
// documents may differ from it.
std::string commit()
{
    constexpr const char* command =
        "cd '" PACKTRACE_SOURCE_DIR
        "' && { commit=$(git rev-parse --short HEAD) && "
        "{ git diff --quiet HEAD -- . ':(exclude)results' ':(exclude)docs' ':(exclude)*.md' || "
        "commit=$commit-dirty; }; echo ${commit:-unknown}; } 2>/dev/null";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command, "r"), pclose);
    char text[64] = {};
    if (!pipe || std::fgets(text, sizeof(text), pipe.get()) == nullptr)
        return "unknown";
    const std::string line(text);
    return line.substr(0, line.find('\n'));
}

std::string instruction_sets()
{
    std::string names;
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            names += (names.empty() ? "" : " ") + isa.name;
    return names;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> context()
{
    return {{"processor", processor()},
            {"instruction_sets", instruction_sets()},
            {"compiler", compiler()},
            {"flags", PACKTRACE_FLAGS},
            {"commit", commit()}};
}

}  // namespace packtrace::bench
