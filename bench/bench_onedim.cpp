#include "core/aligned_array.hpp"
#include "dispatch/kernels.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/onedim.hpp>

#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <vector>

// Systems per second on one thread. `bitsliced` starts from surfaces in memory, like the other
// solvers; `planes` only runs the kernel on bit planes in memory.
namespace packtrace {
namespace {

using onedim::Direction;
using onedim::Intensity;
using onedim::Solver;
using onedim::Surface;

constexpr std::size_t system_count = 4096;

onedim::Systems random_systems(std::size_t length)
{
    std::mt19937 random(16);
    onedim::Systems systems;
    std::vector<Surface> system(length);
    for (std::size_t k = 0; k < system_count; ++k) {
        for (Surface& surface : system) {
            surface.direction = static_cast<Direction>(random() % 2);
            surface.reflectance = static_cast<Intensity>(random() % 3);
            surface.translucence = static_cast<Intensity>(random() % 3);
            surface.emission = static_cast<Intensity>(random() % 3);
        }
        systems.push_back(system);
    }
    return systems;
}

void bench_solver(benchmark::State& state, const onedim::SolveOptions& options)
{
    const onedim::Systems systems = random_systems(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(solve(systems, options));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(system_count));
}

void bench_planes(benchmark::State& state, const std::string& isa)
{
    const abi::OnedimTable& kernel = kernels_of(isa).onedim;
    const auto length = static_cast<std::size_t>(state.range(0));
    const auto words = static_cast<std::size_t>(kernel.words);
    const AlignedArray<std::uint64_t> planes(length * abi::onedim_planes * words);
    const AlignedArray<std::uint64_t> carried(abi::onedim_state_planes * words);
    std::mt19937_64 random(17);
    for (std::size_t i = 0; i < planes.size(); ++i)
        planes[i] = random();
    for (auto _ : state) {
        kernel.solve({planes.data(), length, carried.data()});
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * 64 * kernel.words);
}

void add_lengths(benchmark::internal::Benchmark* benchmark)
{
    benchmark->Arg(8)->Arg(64)->Arg(512);
}

const bool registered = [] {
    const std::string family = "onedim/";
    for (const auto& [name, solver] :
         {std::pair{"scalar", Solver::scalar}, std::pair{"linear", Solver::linear}})
        add_lengths(benchmark::RegisterBenchmark((family + name).c_str(), bench_solver,
                                                 onedim::SolveOptions{solver, "auto"}));
    for (const IsaInfo& isa : list_isas()) {
        if (!isa.supported)
            continue;
        add_lengths(
            benchmark::RegisterBenchmark((family + "bitsliced/" + isa.name).c_str(), bench_solver,
                                         onedim::SolveOptions{Solver::bitsliced, isa.name}));
        add_lengths(benchmark::RegisterBenchmark((family + "planes/" + isa.name).c_str(),
                                                 bench_planes, isa.name));
    }
    return true;
}();

}  // namespace
}  // namespace packtrace
