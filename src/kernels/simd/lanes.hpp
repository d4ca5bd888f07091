#pragma once

// The instruction set that a kernel object is compiled for. The build defines PACKTRACE_ISA (its
// name, and the namespace of all code) and PACKTRACE_LANES (the number of float lanes in a packet),
// and passes the matching -m flags. xsimd's architecture is always named, because its default
// differs between versions under the same flags.

#include "kernel_abi/lists.hpp"

#include <cstddef>
#include <cstdint>

#if !defined(PACKTRACE_ISA) || !defined(PACKTRACE_LANES)
#error "kernel sources are compiled once per instruction set; see kernels.cmake"
#endif

#if PACKTRACE_LANES == 1
#include "kernels/simd/native/one_lane.hpp"
#else
#include <xsimd/xsimd.hpp>
#endif

namespace packtrace::PACKTRACE_ISA {
namespace {

#if PACKTRACE_LANES == 1
template <class T>
using batch = OneLane<T>;
template <class T>
using batch_bool = OneMask<T>;
namespace operations = one_lane_operations;
#else
#if defined(__aarch64__)
using Arch = xsimd::neon64;
#elif PACKTRACE_LANES == 16
using Arch = xsimd::avx512bw;
#elif PACKTRACE_LANES == 8
using Arch = xsimd::fma3<xsimd::avx2>;
#else
using Arch = xsimd::sse4_2;
#endif
// Function templates cannot deduce Real from vreal<Real>, so they take batch<Real>.
template <class T>
using batch = xsimd::batch<T, Arch>;
template <class T>
using batch_bool = xsimd::batch_bool<T, Arch>;
namespace operations = xsimd;
#endif

// The lane types. A mask is not a vector. A packet of doubles has half as many lanes as one of
// floats, except with one lane. Integers are as wide as the reals of the packet.

template <class Real>
using lane_int = abi::lane_int<Real>;

template <class Real>
using vreal = batch<Real>;
template <class Real>
using vint = batch<lane_int<Real>>;
template <class Real>
using vmask = batch_bool<Real>;

template <class Real>
inline constexpr int lanes = static_cast<int>(vreal<Real>::size);

/// The bit pattern of a full packet.
template <class Real>
inline constexpr std::uint32_t all_lanes = (1u << lanes<Real>)-1u;

static_assert(lanes<float> == PACKTRACE_LANES && lanes<double> == (PACKTRACE_LANES + 1) / 2);

/// Reinterprets reals as integers of the same bits, and the reverse.
template <class Real>
inline vint<Real> as_int(batch<Real> x)
{
    return __builtin_bit_cast(vint<Real>, x);
}
inline vreal<float> as_real(vint<float> i)
{
    return __builtin_bit_cast(vreal<float>, i);
}
inline vreal<double> as_real(vint<double> i)
{
    return __builtin_bit_cast(vreal<double>, i);
}

/// Lanes in either mask. On AVX-512 this replaces `|` (native/avx512.hpp).
template <class Real>
inline batch_bool<Real> either(batch_bool<Real> a, batch_bool<Real> b)
{
    return a | b;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
