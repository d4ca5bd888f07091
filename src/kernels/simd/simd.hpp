#pragma once

// The operations that the kernels are written in. xsimd supplies arithmetic and comparisons. What
// xsimd lacks, or what differs between its versions, is in native/.

#include "kernels/simd/lanes.hpp"
#if PACKTRACE_LANES == 1
#include "kernels/simd/native/one.hpp"
#elif defined(__aarch64__)
#include "kernels/simd/native/neon64.hpp"
#elif PACKTRACE_LANES == 16
#include "kernels/simd/native/avx512.hpp"
#elif PACKTRACE_LANES == 8
#include "kernels/simd/native/avx2.hpp"
#else
#include "kernels/simd/native/sse.hpp"
#endif

namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
inline vreal<Real> load(const Real* from)
{
    return vreal<Real>::load_unaligned(from);
}

template <class Real>
inline void store(Real* to, batch<Real> x)
{
    x.store_unaligned(to);
}

/// Writes the lanes of `x` in `pattern` to `to`, in order. It may write a whole packet.
template <class Real>
inline void compress_store(Real* to, std::uint32_t pattern, batch<Real> x)
{
    store(to, compress(pattern, x));
}
inline void compress_store(lane_int<float>* to, std::uint32_t pattern, vint<float> x)
{
    store(to, as_int(compress(pattern, as_real(x))));
}
inline void compress_store(lane_int<double>* to, std::uint32_t pattern, vint<double> x)
{
    store(to, as_int(compress(pattern, as_real(x))));
}

template <class Real>
inline batch<Real> select(batch_bool<Real> active, batch<Real> a, batch<Real> b)
{
    return operations::select(active, a, b);
}

inline vint<float> select(vmask<float> active, vint<float> a, vint<float> b)
{
    return as_int(operations::select(active, as_real(a), as_real(b)));
}
inline vint<double> select(vmask<double> active, vint<double> a, vint<double> b)
{
    return as_int(operations::select(active, as_real(a), as_real(b)));
}

// min and max compile to one instruction where that instruction returns its second operand for NaN
// or equal operands, as on SSE and AVX.

/// b where b < a, else a. With a NaN in either operand the result is a.
template <class Real>
inline batch<Real> min(batch<Real> a, batch<Real> b)
{
#if PACKTRACE_LANES > 1 && defined(__x86_64__)
    return operations::min(b, a);
#else
    return operations::select(b < a, b, a);
#endif
}

/// b where b > a, else a. With a NaN in either operand the result is a.
template <class Real>
inline batch<Real> max(batch<Real> a, batch<Real> b)
{
#if PACKTRACE_LANES > 1 && defined(__x86_64__)
    return operations::max(b, a);
#else
    return operations::select(b > a, b, a);
#endif
}

template <class Real>
inline batch<Real> sqrt(batch<Real> x)
{
    return operations::sqrt(x);
}

template <class Real>
inline batch<Real> abs(batch<Real> x)
{
    return operations::abs(x);
}

/// -x, by flipping the sign bit. xsimd's negation on AVX-512 is 0 - x, which gives +0 for +0.
template <class Real>
inline batch<Real> negated(batch<Real> x)
{
    return as_real(as_int(x) ^ as_int(vreal<Real>(Real(-0.0))));
}

/// `magnitude`, whose sign bit must be clear, with the sign bit of `sign`.
template <class Real>
inline batch<Real> with_sign_of(batch<Real> magnitude, batch<Real> sign)
{
    const auto sign_bit = as_int(vreal<Real>(Real(-0.0)));
    return as_real(as_int(magnitude) | (as_int(sign) & sign_bit));
}

template <class Real>
inline batch<Real> floor(batch<Real> x)
{
    return operations::floor(x);
}

template <class Real>
inline bool any(batch_bool<Real> m)
{
    return bits(m) != 0;
}

template <class Real>
inline bool none(batch_bool<Real> m)
{
    return bits(m) == 0;
}

template <class Real>
inline bool all(batch_bool<Real> m)
{
    return bits(m) == all_lanes<Real>;
}

template <class Real>
inline Real first_lane(batch<Real> x)
{
    alignas(64) Real by_lane[lanes<Real>];
    store(by_lane, x);
    return by_lane[0];
}

/// The bit pattern of the first `count` lanes; of all lanes if `count` is larger.
template <class Real>
inline std::uint32_t first_lanes(int count)
{
    return count >= lanes<Real> ? all_lanes<Real> : (1u << count) - 1u;
}

/// The numbers first, first + 1, … in lane order.
template <class Real>
inline vint<Real> lane_numbers(int first)
{
    alignas(64) static constexpr lane_int<Real> number[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                              8, 9, 10, 11, 12, 13, 14, 15};
    return load(number) + vint<Real>(static_cast<lane_int<Real>>(first));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
