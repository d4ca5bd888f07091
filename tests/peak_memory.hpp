#pragma once

#include <fstream>
#include <string>

// The memory that this process uses, from Linux' /proc.
namespace packtrace::test {

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PACKTRACE_TEST_SHADOWED 1
#endif
#endif

/// Memory that the address sanitizer may hold beside the program's own: shadow memory, freed
/// blocks, and (by default in newer compilers) stack frames of functions that have returned.
#if defined(PACKTRACE_TEST_SHADOWED) || defined(__SANITIZE_ADDRESS__)
inline constexpr long sanitizer_kilobytes = 32768;
#else
inline constexpr long sanitizer_kilobytes = 0;
#endif

/// A value of /proc/self/status in kB; 0 if it is missing.
[[nodiscard]] inline long memory_status(const std::string& name)
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (long kilobytes = 0; word == name + ":" && status >> kilobytes)
            return kilobytes;
    return 0;
}

/// By how much `work` raises the peak of the memory in use, in kB.
template <class Work>
[[nodiscard]] long peak_growth(const Work& work)
{
    // Resets the peak to the memory now in use, if the system permits it.
    std::ofstream("/proc/self/clear_refs") << "5" << std::flush;
    const long before = memory_status("VmHWM");
    work();
    return memory_status("VmHWM") - before;
}

}  // namespace packtrace::test
