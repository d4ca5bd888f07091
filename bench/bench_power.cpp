// The highlights' power against the C library's.
#include "dispatch/kernels.hpp"
#include "names.hpp"
#include "power_error.hpp"
#include "register.hpp"

#include <benchmark/benchmark.h>

#include <cmath>

namespace packtrace::bench {
namespace {

/// Cosines whose powers are above 1e-4, for exponents 10 … 1000; few enough for the first-level
/// cache.
template <class Real>
test::PowerSamples<Real> cosines()
{
    const auto all = test::power_samples<Real>({10, 1000}, 1e-4);
    test::PowerSamples<Real> some;
    for (std::size_t i = 0; i < 1024; ++i) {
        const std::size_t from = i * 16381 % all.x.size();
        some.add(all.x[from], all.n[from]);
    }
    return some;
}

template <class Real>
void packet_power(benchmark::State& state, const std::string& isa)
{
    const auto samples = cosines<Real>();
    const auto& kernels = precision<Real>(kernels_of(isa));
    std::vector<Real> y(samples.x.size());
    const int count = static_cast<int>(y.size());
    for (auto _ : state) {
        kernels.highlight_power(samples.x.data(), samples.n.data(), y.data(), count);
        benchmark::DoNotOptimize(y.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * count);
}

template <class Real>
void scalar_power(benchmark::State& state)
{
    const auto samples = cosines<Real>();
    std::vector<Real> y(samples.x.size());
    for (auto _ : state) {
        for (std::size_t i = 0; i < y.size(); ++i)
            y[i] = std::pow(samples.x[i], samples.n[i]);
        benchmark::DoNotOptimize(y.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(y.size()));
}

template <class Real>
void register_precision()
{
    benchmark::RegisterBenchmark(benchmark_name({"power", "libm", precision_name<Real>()}).c_str(),
                                 scalar_power<Real>);
    for (const std::string& isa : supported_isas())
        benchmark::RegisterBenchmark(
            benchmark_name({"power", isa, precision_name<Real>()}).c_str(),
            [isa](benchmark::State& state) { packet_power<Real>(state, isa); });
}

}  // namespace

void register_power()
{
    register_precision<float>();
    register_precision<double>();
}

}  // namespace packtrace::bench
