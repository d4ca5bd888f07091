#pragma once

// The instruction set a kernel object is compiled for. The build defines PACKTRACE_ISA (the
// name, and the namespace everything lives in) and PACKTRACE_LANES (float lanes of a packet),
// and passes the matching -m flags. The architecture is always named: xsimd's default one
// differs between its versions under the same flags.

#include <cstddef>
#include <cstdint>

#include <xsimd/xsimd.hpp>

#include "kernel_abi/lists.hpp"

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

// The lane types. A mask is not a vector; a packet of doubles has half the lanes of one of
// floats, and its integers are as wide as its reals.

template <class Real>
using lane_int = abi::lane_int<Real>;

template <class Real>
using vreal = xsimd::batch<Real, Arch>;
template <class Real>
using vint = xsimd::batch<lane_int<Real>, Arch>;
template <class Real>
using vmask = xsimd::batch_bool<Real, Arch>;

template <class Real>
inline constexpr int lanes = static_cast<int>(vreal<Real>::size);

/// The bit pattern of a full packet.
template <class Real>
inline constexpr std::uint32_t all_lanes = (1u << lanes<Real>)-1u;

static_assert(lanes<float> == PACKTRACE_LANES && lanes<double> == PACKTRACE_LANES / 2);

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
