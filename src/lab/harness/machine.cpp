#include "lab/harness/machine.hpp"

#include <fstream>

#include "core/run_filter.hpp"

namespace packtrace {

std::string processor_name()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(": ") + 2);
    return "unknown";
}

std::string compiler_name()
{
#if defined(__clang__)
    return "clang " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

std::string commit_name()
{
    const FilterResult git =
        run_filter({"git", "-C", PACKTRACE_SOURCE_DIR, "describe", "--always", "--dirty"}, "");
    if (!git.started || git.exit_code != 0)
        return "unknown";
    return git.output.substr(0, git.output.find('\n'));
}

}  // namespace packtrace
