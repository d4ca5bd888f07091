// The power of highlights, x^n for x in [0, 1 + 1e-6] and n from 1 to 10000, against long double.
#include "catch.hpp"
#include "power_error.hpp"
#include "same_bits.hpp"
#include "simd_packet.hpp"

namespace packtrace::test {
namespace {

/// Bound of the error of powers above 1e-4, in units of the last place; 1.3 was measured
/// (results/highlight_power.json).
constexpr double ulp_bound = 2.0;

/// Bound of the absolute error of all powers: the last place of 1.
template <class Real>
constexpr double absolute_bound = static_cast<double>(std::numeric_limits<Real>::epsilon());

template <class Real>
constexpr double smallest_normal = static_cast<double>(std::numeric_limits<Real>::min());

/// Samples with powers on both sides of the smallest normal number.
template <class Real>
PowerSamples<Real> around_underflow()
{
    PowerSamples<Real> samples;
    for (const ExponentDecade& decade : exponent_decades)
        for (const double n : exponents_of(decade)) {
            const auto root = static_cast<Real>(std::pow(smallest_normal<Real>, 1.0 / n));
            Real x = root;
            for (int step = 0; step < 200; ++step, x = std::nextafter(x, Real(1)))
                samples.add(x, static_cast<Real>(n));
            x = root;
            for (int step = 0; step < 200; ++step, x = std::nextafter(x, Real(0)))
                samples.add(x, static_cast<Real>(n));
            for (int half = 1; half < 60; ++half)
                samples.add(root * std::ldexp(Real(1), -half), static_cast<Real>(n));
        }
    return samples;
}

/// The number of powers that are neither 0 nor normal, or on the wrong side of the smallest normal
/// number by more than the error of the power there.
template <class Real>
int wrong_underflows(const PowerSamples<Real>& samples, const std::vector<Real>& y)
{
    const long double smallest = std::numeric_limits<Real>::min();
    const long double doubt = 1e-5L;  // relative
    int wrong = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
        const long double exact = exact_power(samples.x[i], samples.n[i]);
        const bool zero = y[i] == 0;
        wrong += !zero && y[i] < std::numeric_limits<Real>::min();
        wrong += !zero && exact < smallest * (1 - doubt);
        wrong += zero && exact > smallest * (1 + doubt);
    }
    return wrong;
}

}  // namespace

TEMPLATE_TEST_CASE("highlight powers keep their bound in units of the last place", "[power]", float,
                   double)
{
    for (const ExponentDecade& decade : exponent_decades) {
        const auto samples = power_samples<TestType>(decade, 1e-4);
        for (const abi::KernelTable* table : supported_kernels()) {
            CAPTURE(table->isa, decade.first);
            const PowerError error = power_error(samples, highlight_powers(*table, samples));
            CHECK(error.counted > 10000);
            CHECK(error.max_ulp <= ulp_bound);
            CHECK(error.max_abs <= absolute_bound<TestType>);
        }
    }
}

TEMPLATE_TEST_CASE("the error of small highlight powers is no larger than that of large ones",
                   "[power]", float, double)
{
    for (const ExponentDecade& decade : exponent_decades) {
        const auto samples = power_samples<TestType>(decade, smallest_normal<TestType>);
        for (const abi::KernelTable* table : supported_kernels()) {
            CAPTURE(table->isa, decade.first);
            const PowerError error = power_error(samples, highlight_powers(*table, samples));
            CHECK(error.max_abs <= absolute_bound<TestType>);
        }
    }
}

TEMPLATE_TEST_CASE("a power below the smallest normal number is exactly 0", "[power]", float,
                   double)
{
    const auto samples = around_underflow<TestType>();
    for (const abi::KernelTable* table : supported_kernels()) {
        CAPTURE(table->isa);
        CHECK(wrong_underflows(samples, highlight_powers(*table, samples)) == 0);
    }
}

TEMPLATE_TEST_CASE("powers of 0 and 1 are exact", "[power]", float, double)
{
    PowerSamples<TestType> samples;
    for (const double n : {1.0, 1.5, 10.0, 500.0, 10000.0}) {
        samples.add(TestType(0), static_cast<TestType>(n));
        samples.add(TestType(1), static_cast<TestType>(n));
    }
    for (const abi::KernelTable* table : supported_kernels()) {
        CAPTURE(table->isa);
        const std::vector<TestType> y = highlight_powers(*table, samples);
        for (std::size_t i = 0; i < y.size(); ++i)
            CHECK(y[i] == samples.x[i]);
    }
}

TEMPLATE_TEST_CASE("highlight powers have the same bits for every width with fused multiply-add",
                   "[power]", float, double)
{
    for (const ExponentDecade& decade : exponent_decades) {
        const auto samples = power_samples<TestType>(decade, smallest_normal<TestType>);
        std::vector<TestType> first;
        for (const abi::KernelTable* table : supported_kernels()) {
            if (!is_fused(*table))
                continue;
            CAPTURE(table->isa, decade.first);
            const std::vector<TestType> y = highlight_powers(*table, samples);
            if (first.empty())
                first = y;
            CHECK(different_bits(y, first) == 0);
        }
    }
}

}  // namespace packtrace::test
