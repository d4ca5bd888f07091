// Moving spheres of a RayScene: refitting its BVH against building a new one, and closest hits with
// either BVH.
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

/// Spheres that move at random, by two thirds of their radius in each step.
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

enum class BvhState { refitted, built };

/// Closest hits after `steps` steps, in a BVH that was refitted in each step or built after the
/// last.
void trace(benchmark::State& state, int steps, BvhState bvh)
{
    Swarm swarm;
    RayScene<float> scene(swarm.scene);
    (void)scene.update(swarm.scene, std::vector<std::int32_t>{0});
    double cost = 1.0;
    for (int i = 0; i < steps; ++i) {
        swarm.step();
        cost = scene.update(swarm.scene).cost;
    }
    if (bvh == BvhState::built)
        scene = RayScene<float>(swarm.scene);
    const auto rays = rays_within(20'000);
    std::vector<SurfaceHit<float>> hits(rays.size());
    for (auto _ : state)
        scene.closest_hits(rays, hits);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
    state.counters["cost"] = bvh == BvhState::built ? 1.0 : cost;
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
        for (const BvhState bvh : {BvhState::refitted, BvhState::built})
            add("trace/" + std::string(bvh == BvhState::built ? "built" : "refitted") +
                    "/steps:" + std::to_string(steps),
                [steps, bvh](benchmark::State& state) { trace(state, steps, bvh); });
}

}  // namespace packtrace::bench
