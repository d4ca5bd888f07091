#include "dispatch/kernels.hpp"

namespace packtrace {

// Checks exactly the features that each object is compiled with (kernels.cmake), by names that g++
// and clang accept. The builtins also check that the operating system saves the registers.
bool cpu_runs(std::string_view isa)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    const bool sse42 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
    const bool avx2 = sse42 && __builtin_cpu_supports("avx") && __builtin_cpu_supports("avx2") &&
                      __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
                      __builtin_cpu_supports("bmi2");
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") &&
                        __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    if (isa == "sse42")
        return sse42;
    if (isa == "one_lane" || isa == "sse_fma" || isa == "avx2")
        return avx2;
    return isa == "avx512" && avx512;
#else
    return isa == "one_lane" || isa == "neon64";
#endif
}

}  // namespace packtrace
