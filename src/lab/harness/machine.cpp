#include "lab/harness/machine.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

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

double memory_limit()
{
    const double machine =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return machine;
    return std::min(machine, static_cast<double>(limit.rlim_cur));
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
