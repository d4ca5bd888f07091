#pragma once

#include "kernels/simd/exact_product.hpp"
#include "kernels/simd/float_bits.hpp"

#include <array>
#include <cstddef>
#include <utility>

// x^n of a highlight, for cosines x and exponents up to 10 000. xsimd's pow differs between packet
// widths, so this function uses a fixed sequence of operations. The logarithm is an unevaluated sum
// of two reals, because its rounding error is multiplied by n.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct TwoPart {
    vreal<Real> high;
    vreal<Real> low;
};

/// The number of terms with which the two series are accurate to half a unit in Real's last place.
template <class Real>
struct PowerSeries;
template <>
struct PowerSeries<float> {
    static constexpr std::size_t log_terms = 4;
    static constexpr std::size_t exp_terms = 8;
};
template <>
struct PowerSeries<double> {
    static constexpr std::size_t log_terms = 11;
    static constexpr std::size_t exp_terms = 14;
};

inline constexpr long double ln_2 = 0.693147180559945309417232121458176568L;
inline constexpr long double two_over_ln_2 = 2.88539008177792681471984936200378427L;
inline constexpr double sqrt_2 = 1.41421356237309504880;

/// 2/(3 ln 2), 2/(5 ln 2), …: the coefficients of log2_tail.
template <class Real>
consteval auto log2_coefficients()
{
    std::array<Real, PowerSeries<Real>::log_terms> c{};
    for (std::size_t k = 0; k < c.size(); ++k)
        c[k] = Real(two_over_ln_2 / static_cast<long double>(2 * k + 3));
    return c;
}

/// (ln 2)^k / k!: Taylor's coefficients of 2^f.
template <class Real>
consteval auto exp2_coefficients()
{
    std::array<Real, PowerSeries<Real>::exp_terms> c{};
    long double next = 1.0L;
    for (std::size_t k = 0; k < c.size(); ++k) {
        c[k] = Real(next);
        next *= ln_2 / static_cast<long double>(k + 1);
    }
    return c;
}

// As static arrays the coefficients are not stored as long double and converted at run time.
template <class Real>
inline constexpr auto log2_series = log2_coefficients<Real>();
template <class Real>
inline constexpr auto exp2_series = exp2_coefficients<Real>();

/// c[0] + x (c[1] + x (c[2] + …)) by Horner's rule. A fold expression writes one statement per
/// term; GCC would not unroll a loop over the array.
template <class Real, std::size_t n, std::size_t... k>
inline batch<Real> horner(const std::array<Real, n>& c, batch<Real> x, std::index_sequence<k...>)
{
    vreal<Real> sum(c[n - 1]);
    ((sum = madd(sum, x, vreal<Real>(c[n - 2 - k]))), ...);
    return sum;
}

template <class Real, std::size_t n>
inline batch<Real> horner(const std::array<Real, n>& c, batch<Real> x)
{
    return horner<Real>(c, x, std::make_index_sequence<n - 1>{});
}

/// (2/ln 2) s³ (1/3 + s²/5 + s⁴/7 + …): the terms of atanh's series after the first, |s| < 0.172.
template <class Real>
inline batch<Real> log2_tail(batch<Real> s)
{
    const vreal<Real> z = s * s;
    return s * z * horner<Real>(log2_series<Real>, z);
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

    // s in two parts: corrected for the rounding of m + 1 and of the quotient.
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

/// 2^f for |f| <= 0.51.
template <class Real>
inline batch<Real> exp2_fraction(batch<Real> f)
{
    return horner<Real>(exp2_series<Real>, f);
}

/// x^n for x in [0, 1 + 1e-6], 0 < n <= 10 000. Exactly 0 if the result would be below the smallest
/// normal number, and for a denormal x.
template <class Real>
inline batch<Real> highlight_power(batch<Real> x, batch<Real> n)
{
    const TwoPart<Real> log = log2_two_part<Real>(x);
    const vreal<Real> smallest(static_cast<Real>(FloatFormat<Real>::smallest_exponent));
    const vreal<Real> y_high = n * log.high;
    const vreal<Real> y_low = madd(n, log.low, exact_msub(n, log.high, y_high));

    // The low part may be a hundredth of the high part, so it counts in the integer exponent too.
    const vreal<Real> y = y_high + y_low;
    const vreal<Real> rest = y_low - (y - y_high);

    // Lanes whose result is 0 are clamped to the range of the conversion to integers.
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
