#pragma once

// The instruction set a kernel object is compiled for. The build defines PACKTRACE_ISA (the
// name, and the namespace everything lives in) and PACKTRACE_LANES (float lanes of a packet),
// and passes the matching -m flags. The architecture is always named: xsimd's default one
// differs between its versions under the same flags.

#include <xsimd/xsimd.hpp>

#if !defined(PACKTRACE_ISA) || !defined(PACKTRACE_LANES)
#error "kernel sources are compiled once per instruction set; see kernels.cmake"
#endif

namespace packtrace::PACKTRACE_ISA {
namespace {

#if defined(__aarch64__)
using Arch = xsimd::neon64;
#elif PACKTRACE_LANES == 16
using Arch = xsimd::avx512bw;
#elif PACKTRACE_LANES == 8
using Arch = xsimd::fma3<xsimd::avx2>;
#else
using Arch = xsimd::sse4_2;
#endif

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
