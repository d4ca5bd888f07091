// Moving spheres of a RayScene: refitting its hierarchy against building it anew, both from the
// scene on, and closest hits by either hierarchy.
#include "names.hpp"
#include "register.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

namespace packtrace::bench {
namespace {

constexpr int spheres = 100'000;

/// Spheres that go about at random by two thirds of their radius a step.
class Swarm {
public:
    Scene scene = generate_random_spheres({.count = spheres, .radius = 0.003});

    void step()
    {
        for (Object& object : scene.objects)
            std::get<Sphere>(object.surface).center +=
                Vec3(by_(random_), by_(random_), by_(random_));
    }

private:
    std::mt19937 random_{3};
    std::uniform_real_distribution<double> by_{-0.002, 0.002};
};

void refit(benchmark::State& state)
{
    Swarm swarm;
    RayScene<float> rays(swarm.scene);
    (void)rays.update(swarm.scene, std::vector<std::int32_t>{0});
    std::vector<std::int32_t> all;
    for (std::int32_t i = 0; i < spheres; ++i)
        all.push_back(i);
    double rebuilt = 0.0;
    for (auto _ : state) {
        state.PauseTiming();
        swarm.step();
        state.ResumeTiming();
        rebuilt += rays.update(swarm.scene, all).rebuilt ? 1.0 : 0.0;
    }
    state.SetItemsProcessed(state.iterations() * spheres);
    state.counters["rebuilt"] = rebuilt;
}

void build(benchmark::State& state)
{
    Swarm swarm;
    for (auto _ : state) {
        state.PauseTiming();
        swarm.step();
        state.ResumeTiming();
        benchmark::DoNotOptimize(RayScene<float>(swarm.scene));
    }
    state.SetItemsProcessed(state.iterations() * spheres);
}

std::vector<Ray<float>> rays_within(std::size_t count)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(0.0f, 1.0f);
    std::vector<Ray<float>> rays(count);
    for (Ray<float>& ray : rays)
        for (int axis = 0; axis < 3; ++axis) {
            ray.org[axis] = place(random);
            ray.dir[axis] = place(random) - 0.5f;
        }
    return rays;
}

/// Closest hits after so many steps, in a hierarchy that was refitted all along or built at last.
void trace(benchmark::State& state, int steps, bool fresh)
{
    Swarm swarm;
    RayScene<float> scene(swarm.scene);
    (void)scene.update(swarm.scene, std::vector<std::int32_t>{0});
    double cost = 1.0;
    for (int i = 0; i < steps; ++i) {
        swarm.step();
        cost = scene.update(swarm.scene).cost;
    }
    if (fresh)
        scene = RayScene<float>(swarm.scene);
    const auto rays = rays_within(20'000);
    std::vector<SurfaceHit<float>> hits(rays.size());
    for (auto _ : state)
        scene.closest_hits(rays, hits);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
    state.counters["cost"] = fresh ? 1.0 : cost;
}

}  // namespace

void register_updates()
{
    const auto add = [](const std::string& name, auto run) {
        benchmark::RegisterBenchmark(benchmark_name({"update", name}).c_str(), run)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    };
    add("refit", refit);
    add("build", build);
    for (const int steps : {10, 30, 100})
        for (const bool fresh : {false, true})
            add("trace/" + std::string(fresh ? "built" : "refitted") +
                    "/steps:" + std::to_string(steps),
                [steps, fresh](benchmark::State& state) { trace(state, steps, fresh); });
}

}  // namespace packtrace::bench
