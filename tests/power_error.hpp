#pragma once

#include "dispatch/kernels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

// The error of the kernels' highlight_power against long double.
namespace packtrace::test {

/// Exponents from `first` to `last`.
struct ExponentDecade {
    double first;
    double last;
};

inline constexpr ExponentDecade exponent_decades[] = {
    {1, 10}, {10, 100}, {100, 1000}, {1000, 10000}};

template <class Real>
struct PowerSamples {
    std::vector<Real> x;
    std::vector<Real> n;

    void add(Real base, Real exponent)
    {
        x.push_back(base);
        n.push_back(exponent);
    }
};

/// Integer and fractional exponents, spread evenly over the logarithm of a decade.
[[nodiscard]] inline std::vector<double> exponents_of(const ExponentDecade& decade)
{
    constexpr int count = 48;
    std::vector<double> exponents{decade.first, decade.last};
    for (int i = 0; i < count; ++i) {
        const double share = (i + 0.5) / count;
        const double n = decade.first * std::pow(decade.last / decade.first, share);
        exponents.push_back(i % 2 == 0 ? std::round(n) : n);
    }
    return exponents;
}

/// Bases in [0, 1 + 1e-6]. Some give powers from 1 down to `smallest`, spread evenly over the
/// logarithm of the power; the others are spread evenly over the whole range.
template <class Real>
[[nodiscard]] PowerSamples<Real> power_samples(const ExponentDecade& decade, double smallest,
                                               int per_exponent = 400)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    PowerSamples<Real> samples;
    for (const double n : exponents_of(decade)) {
        for (int i = 0; i < per_exponent; ++i) {
            const double y = std::pow(smallest, share(random));
            samples.add(static_cast<Real>(std::pow(y, 1.0 / n)), static_cast<Real>(n));
        }
        for (int i = 0; i < per_exponent / 8; ++i)
            samples.add(static_cast<Real>(share(random)), static_cast<Real>(n));
        for (const double x : {0.0, 0.5, 1.0 - 1e-6, 1.0, 1.0 + 1e-6})
            samples.add(static_cast<Real>(x), static_cast<Real>(n));
    }
    return samples;
}

template <class Real>
[[nodiscard]] std::vector<Real> highlight_powers(const abi::KernelTable& table,
                                                 const PowerSamples<Real>& samples)
{
    std::vector<Real> y(samples.x.size());
    precision<Real>(table).highlight_power(samples.x.data(), samples.n.data(), y.data(),
                                           static_cast<int>(y.size()));
    return y;
}

[[nodiscard]] inline long double exact_power(long double x, long double n)
{
    return std::pow(x, n);
}

/// The distance of `y` from `exact` in units of Real's last place at `exact`.
template <class Real>
[[nodiscard]] double ulps(Real y, long double exact)
{
    using Limits = std::numeric_limits<Real>;
    const int exponent = std::max(std::ilogb(exact), Limits::min_exponent - 1);
    const long double unit = std::ldexp(1.0L, exponent - (Limits::digits - 1));
    return static_cast<double>(std::abs(static_cast<long double>(y) - exact) / unit);
}

struct PowerError {
    double max_ulp = 0.0;  ///< over powers above 1e-4
    double p99_ulp = 0.0;  ///< over powers above 1e-4
    double max_abs = 0.0;  ///< over all powers
    int counted = 0;       ///< powers above 1e-4
};

template <class Real>
[[nodiscard]] PowerError power_error(const PowerSamples<Real>& samples, const std::vector<Real>& y)
{
    PowerError error;
    std::vector<double> distances;
    for (std::size_t i = 0; i < y.size(); ++i) {
        const long double exact = exact_power(samples.x[i], samples.n[i]);
        const auto distance = std::abs(static_cast<long double>(y[i]) - exact);
        error.max_abs = std::max(error.max_abs, static_cast<double>(distance));
        if (exact > 1e-4L)
            distances.push_back(ulps(y[i], exact));
    }
    std::sort(distances.begin(), distances.end());
    error.counted = static_cast<int>(distances.size());
    if (!distances.empty()) {
        error.max_ulp = distances.back();
        error.p99_ulp = distances[distances.size() * 99 / 100];
    }
    return error;
}

}  // namespace packtrace::test
