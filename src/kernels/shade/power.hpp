#pragma once

#include "kernels/simd/exact_product.hpp"
#include "kernels/simd/float_bits.hpp"

// x^n of a highlight, for cosines x and exponents up to 10 000. xsimd's pow differs between
// widths, so this one is made of fixed operations: the logarithm as an unevaluated sum of two
// reals, because its rounding error is multiplied by n.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct TwoPart {
    vreal<Real> high;
    vreal<Real> low;
};

template <class Real>
struct PowerSeries;
template <>
struct PowerSeries<float> {
    static constexpr int log_terms = 4;
    static constexpr int exp_terms = 7;
};
template <>
struct PowerSeries<double> {
    static constexpr int log_terms = 11;
    static constexpr int exp_terms = 13;
};

inline constexpr long double ln_2 = 0.693147180559945309417232121458176568L;
inline constexpr long double two_over_ln_2 = 2.88539008177792681471984936200378427L;
inline constexpr double sqrt_2 = 1.41421356237309504880;

constexpr long double exp2_coefficient(int k)
{
    long double c = 1.0L;
    for (int i = 1; i <= k; ++i)
        c *= ln_2 / i;
    return c;
}

/// (2/ln 2) s³ (1/3 + s²/5 + s⁴/7 + …): what atanh's series adds to its first term, |s| < 0.172.
template <class Real>
inline batch<Real> log2_tail(batch<Real> s)
{
    constexpr int terms = PowerSeries<Real>::log_terms;
    const vreal<Real> z = s * s;
    vreal<Real> sum(Real(two_over_ln_2 / (2 * terms + 1)));
    for (int k = terms - 1; k >= 1; --k)
        sum = madd(sum, z, vreal<Real>(Real(two_over_ln_2 / (2 * k + 1))));
    return s * z * sum;
}

/// log2 of a normal positive x, as (2/ln 2) atanh(s) with s = (m - 1) / (m + 1) and the
/// mantissa m in [1/√2, √2].
template <class Real>
inline TwoPart<Real> log2_two_part(batch<Real> x)
{
    constexpr Real scale_high = Real(two_over_ln_2);
    constexpr Real scale_low = Real(two_over_ln_2 - static_cast<long double>(scale_high));

    vreal<Real> m = mantissa_of(x);
    vreal<Real> exponent = to_real<Real>(exponent_of(x));
    const auto large = m > vreal<Real>(Real(sqrt_2));
    m = select(large, m * vreal<Real>(Real(0.5)), m);
    exponent = select(large, exponent + vreal<Real>(Real(1)), exponent);

    // s in two parts: the rounding of m + 1 and of the quotient are both put back.
    const vreal<Real> f = m - vreal<Real>(Real(1));
    const vreal<Real> g = m + vreal<Real>(Real(1));
    const vreal<Real> g_low = m - (g - vreal<Real>(Real(1)));
    const vreal<Real> inverse = vreal<Real>(Real(1)) / g;
    const vreal<Real> s = f * inverse;
    const vreal<Real> s_low = nmadd(s, g_low, negated(exact_msub(s, g, f))) * inverse;

    const vreal<Real> product = vreal<Real>(scale_high) * s;
    vreal<Real> low = exact_msub(vreal<Real>(scale_high), s, product);
    low = madd(vreal<Real>(scale_low), s, low);
    low = madd(vreal<Real>(scale_high), s_low, low);
    low = low + log2_tail<Real>(s);

    TwoPart<Real> result;
    result.high = exponent + product;
    result.low = low + (product - (result.high - exponent));
    return result;
}

/// 2^f for |f| <= 0.51, by Taylor's series.
template <class Real>
inline batch<Real> exp2_fraction(batch<Real> f)
{
    constexpr int terms = PowerSeries<Real>::exp_terms;
    vreal<Real> sum(Real(exp2_coefficient(terms)));
    for (int k = terms - 1; k >= 0; --k)
        sum = madd(sum, f, vreal<Real>(Real(exp2_coefficient(k))));
    return sum;
}

/// x^n for x in [0, 1 + 1e-6], 0 < n <= 10 000; exactly 0 where the result would be below the
/// smallest normal number, and for a denormal x.
template <class Real>
inline batch<Real> highlight_power(batch<Real> x, batch<Real> n)
{
    const TwoPart<Real> log = log2_two_part<Real>(x);
    const vreal<Real> smallest(static_cast<Real>(FloatFormat<Real>::smallest_exponent));
    const vreal<Real> y_high = n * log.high;
    const vreal<Real> y_low = madd(n, log.low, exact_msub(n, log.high, y_high));

    // The low part may be a hundredth of the high one: it counts in the whole exponent too.
    const vreal<Real> y = y_high + y_low;
    const vreal<Real> rest = y_low - (y - y_high);

    // Lanes that end as 0 are kept in the range where the integer conversion holds.
    const vreal<Real> clamped = max(y, smallest);
    const vreal<Real> shift(FloatFormat<Real>::integer_shift);
    const vreal<Real> whole = (clamped + shift) - shift;
    const vreal<Real> power = exp2_fraction<Real>((clamped - whole) + rest);
    const vreal<Real> scaled = scale_by_power<Real>(power, to_int<Real>(clamped));

    const vreal<Real> smallest_x(static_cast<Real>(FloatFormat<Real>::smallest_normal));
    return select((y > smallest) & (x >= smallest_x), scaled, vreal<Real>(Real(0)));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
