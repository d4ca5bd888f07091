#pragma once

#include "kernels/simd/simd.hpp"

#include <limits>

// The parts of floating-point numbers. Integers are converted to and from reals by adding 1.5 *
// 2^52 (1.5 * 2^23 for floats): the last bits of the sum are the integer. This is one operation on
// every instruction set.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct FloatFormat {
    using Limits = std::numeric_limits<Real>;
    using Int = lane_int<Real>;

    static constexpr int mantissa_bits = Limits::digits - 1;
    static constexpr Int exponent_bias = Limits::max_exponent - 1;
    static constexpr Int mantissa_mask = (Int{1} << mantissa_bits) - 1;
    static constexpr Int one = exponent_bias << mantissa_bits;
    static constexpr Real integer_shift = Real(Int{3} << (mantissa_bits - 1));
    static constexpr int smallest_exponent = Limits::min_exponent - 1;
    static constexpr Real smallest_normal = Limits::min();
};
static_assert(FloatFormat<float>::one == 0x3f800000 &&
              FloatFormat<double>::integer_shift == 6755399441055744.0);

/// The nearest integer to x, |x| < 2^21.
template <class Real>
inline vint<Real> to_int(batch<Real> x)
{
    const vreal<Real> shift(FloatFormat<Real>::integer_shift);
    return as_int(x + shift) - as_int(shift);
}

/// The real that is equal to i, |i| < 2^21.
template <class Real>
inline vreal<Real> to_real(vint<Real> i)
{
    const vreal<Real> shift(FloatFormat<Real>::integer_shift);
    return as_real(i + as_int(shift)) - shift;
}

/// floor(log2 x) for a normal positive x.
template <class Real>
inline vint<Real> exponent_of(batch<Real> x)
{
    using Format = FloatFormat<Real>;
    return (as_int(x) >> Format::mantissa_bits) - vint<Real>(Format::exponent_bias);
}

/// x / 2^exponent_of(x), in [1, 2).
template <class Real>
inline batch<Real> mantissa_of(batch<Real> x)
{
    using Format = FloatFormat<Real>;
    return as_real((as_int(x) & vint<Real>(Format::mantissa_mask)) | vint<Real>(Format::one));
}

/// x * 2^i for a normal x and a normal result.
template <class Real>
inline batch<Real> scale_by_power(batch<Real> x, vint<Real> i)
{
    return as_real(as_int(x) + (i << FloatFormat<Real>::mantissa_bits));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
