#include "lab/harness/machine.hpp"

#include <cstdlib>
#include <fstream>

namespace packtrace {
namespace {

const double load_before_main = load_now();

}  // namespace

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

double load_now()
{
    double minute = 0.0;
    return getloadavg(&minute, 1) == 1 ? minute : 0.0;
}

double load_at_start()
{
    return load_before_main;
}

}  // namespace packtrace
