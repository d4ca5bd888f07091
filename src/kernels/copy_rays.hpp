#pragma once

#if defined(__x86_64__)
#include "kernels/native/copy_rays_x86.hpp"
#else

#include "kernels/isa.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// As many places behind the last ray may be overwritten.
inline constexpr int copy_step = 1;

/// Copies the `rays` that have a bit for `slot` in `met`, and returns how many they are.
inline int copy_rays(std::uint8_t* to, const std::uint8_t* rays, const std::uint8_t* met, int count,
                     int slot)
{
    int copied = 0;
    for (int i = 0; i < count; ++i) {
        to[copied] = rays[i];
        copied += met[i] >> slot & 1;
    }
    return copied;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA

#endif
