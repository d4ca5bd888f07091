#pragma once

#include <cstdint>

#if !defined(__aarch64__)
#include <immintrin.h>
#endif

#include "kernels/simd/lanes.hpp"

// The processor's time counter. It runs at a constant rate, whatever the clock frequency of the
// cores.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline std::uint64_t ticks()
{
#if defined(__aarch64__)
    std::uint64_t now;
    asm volatile("mrs %0, cntvct_el0" : "=r"(now));
    return now;
#else
    return __builtin_ia32_rdtsc();
#endif
}

/// The time after all earlier instructions have finished and before any later one starts.
inline std::uint64_t fenced_ticks()
{
#if defined(__aarch64__)
    asm volatile("isb" ::: "memory");
    const std::uint64_t now = ticks();
    asm volatile("isb" ::: "memory");
#else
    _mm_lfence();
    const std::uint64_t now = ticks();
    _mm_lfence();
#endif
    return now;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
