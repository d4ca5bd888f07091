#pragma once

#include "kernels/halves.hpp"
#include "kernels/power.hpp"

// x^n of a highlight in single precision by way of double, rounded once. Double's own rounding is
// so far below single's that one part of the logarithm is enough, and fewer terms of either
// series: 2^-32 of y counts in n log2 x, which is at most 126.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// log2 of a positive x to 2^-40 of it, as (2/ln 2) atanh(s).
inline vreal<double> log2_of(vreal<double> x)
{
    constexpr int terms = 7;
    vreal<double> m = mantissa_of(x);
    vreal<double> exponent = to_real<double>(exponent_of(x));
    const auto large = m > vreal<double>(sqrt_2);
    m = select(large, m * vreal<double>(0.5), m);
    exponent = select(large, exponent + vreal<double>(1.0), exponent);
    const vreal<double> s = (m - vreal<double>(1.0)) / (m + vreal<double>(1.0));
    const vreal<double> z = s * s;
    vreal<double> sum(double(two_over_ln_2 / (2 * terms + 1)));
    for (int k = terms - 1; k >= 0; --k)
        sum = madd(sum, z, vreal<double>(double(two_over_ln_2 / (2 * k + 1))));
    return madd(s, sum, exponent);
}

/// 2^y for |y| below 1000, to 2^-33 of it.
inline vreal<double> exp2_of(vreal<double> y)
{
    constexpr int terms = 9;
    const vreal<double> shift(FloatFormat<double>::integer_shift);
    const vreal<double> whole = (y + shift) - shift;
    const vreal<double> f = y - whole;
    vreal<double> sum(double(exp2_coefficient(terms)));
    for (int k = terms - 1; k >= 0; --k)
        sum = madd(sum, f, vreal<double>(double(exp2_coefficient(k))));
    return scale_by_power<double>(sum, to_int<double>(y));
}

inline vreal<double> half_power(vreal<double> x, vreal<double> n)
{
    // Clamped to below what single precision can hold, which ends as 0.
    return exp2_of(max(n * log2_of(x), vreal<double>(-200.0)));
}

/// As highlight_power has it: exactly 0 below the smallest normal number, and for a denormal x.
inline vreal<float> precise_power(vreal<float> x, vreal<float> n)
{
    const vreal<double> low = half_power(low_half(x), low_half(n));
    const vreal<double> high = half_power(high_half(x), high_half(n));
    const vreal<float> y = joined(low, high);
    const vreal<float> smallest(FloatFormat<float>::smallest_normal);
    return select((y >= smallest) & (x >= smallest), y, vreal<float>(0.0f));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
