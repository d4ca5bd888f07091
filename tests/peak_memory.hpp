#pragma once

#include <fstream>
#include <string>

// What this process holds in memory, from Linux' /proc.
namespace packtrace::test {

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PACKTRACE_TEST_SHADOWED 1
#endif
#endif

/// What the address sanitizer may hold beside the program's own memory: shadows of what is
/// touched, blocks that were freed, and, by default in newer compilers, frames that were left.
#if defined(PACKTRACE_TEST_SHADOWED) || defined(__SANITIZE_ADDRESS__)
inline constexpr long sanitizer_kilobytes = 32768;
#else
inline constexpr long sanitizer_kilobytes = 0;
#endif

/// A line of /proc/self/status in kB; 0 where there is none.
[[nodiscard]] inline long memory_status(const std::string& name)
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (long kilobytes = 0; word == name + ":" && status >> kilobytes)
            return kilobytes;
    return 0;
}

/// How far `work` raises the peak of the memory in use, in kB.
template <class Work>
[[nodiscard]] long peak_growth(const Work& work)
{
    // Lets the peak start from what is in use now, where the system allows it.
    std::ofstream("/proc/self/clear_refs") << "5" << std::flush;
    const long before = memory_status("VmHWM");
    work();
    return memory_status("VmHWM") - before;
}

}  // namespace packtrace::test
