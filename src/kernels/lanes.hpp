#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel_abi/lists.hpp"
#include "kernels/isa.hpp"

// The lane types. A mask is not a vector; a packet of doubles has half the lanes of one of
// floats, and its integers are as wide as its reals.
namespace packtrace::PACKTRACE_ISA {
namespace {

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
