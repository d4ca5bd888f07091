// Whole frames of note 001: packets of every instruction set and the scalar reference.
#include "names.hpp"
#include "reference/render_reference.hpp"
#include "register.hpp"
#include "scenes.hpp"
#include <packtrace/renderer.hpp>

#include <benchmark/benchmark.h>

namespace packtrace::bench {
namespace {

constexpr int size = 1024;  ///< pixels along each edge

template <class Real>
void packet_frame(benchmark::State& state, const std::string& isa, int threads)
{
    const Renderer<Real> renderer(test::four_spheres(size, size), {.isa = isa, .threads = threads});
    Image<Real> image(size, size);
    const auto rays = static_cast<std::int64_t>(renderer.render(image).total());
    for (auto _ : state)
        benchmark::DoNotOptimize(renderer.render(image));
    state.SetItemsProcessed(state.iterations() * rays);
}

/// The reference traces the same rays as the packets, which count them.
template <class Real>
void scalar_frame(benchmark::State& state, int threads)
{
    const Scene scene = test::four_spheres(size, size);
    Image<Real> image;
    const auto rays = static_cast<std::int64_t>(Renderer<Real>(scene).render(image).total());
    for (auto _ : state)
        benchmark::DoNotOptimize(render_reference<Real>(scene, {.threads = threads}));
    state.SetItemsProcessed(state.iterations() * rays);
}

void by_the_clock(benchmark::internal::Benchmark* benchmark)
{
    benchmark->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
}

template <class Real>
void register_precision(int threads)
{
    const std::string last = "threads:" + std::to_string(threads);
    by_the_clock(benchmark::RegisterBenchmark(
        benchmark_name({"frame", "scalar", precision_name<Real>(), last}).c_str(),
        [threads](benchmark::State& state) { scalar_frame<Real>(state, threads); }));
    for (const std::string& isa : supported_isas())
        by_the_clock(benchmark::RegisterBenchmark(
            benchmark_name({"frame", isa, precision_name<Real>(), last}).c_str(),
            [isa, threads](benchmark::State& state) { packet_frame<Real>(state, isa, threads); }));
}

}  // namespace

void register_frames()
{
    for (const int threads : {1, 2}) {
        register_precision<float>(threads);
        register_precision<double>(threads);
    }
}

}  // namespace packtrace::bench
