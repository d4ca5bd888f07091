// Closest hits of camera rays, without shading, on one thread.
#include "core/aligned_array.hpp"
#include "dispatch/kernels.hpp"
#include "lower/packed_scene.hpp"
#include "names.hpp"
#include "register.hpp"
#include "render/camera_view.hpp"
#include "scenes.hpp"
#include <packtrace/isa.hpp>

#include <benchmark/benchmark.h>

namespace packtrace::bench {
namespace {

constexpr int size = 1024;  ///< pixels along each edge, whole tiles

/// Traces all tiles of a scene, one after the other.
template <class Real>
class ClosestHits {
public:
    ClosestHits(const Scene& scene, const std::string& isa)
        : lowered_(lower(scene, accuracy_in<Real>({}))),
          packed_(lowered_),
          camera_(camera_view<Real>(scene, lowered_)),
          kernels_(kernels_for(precision<Real>(kernels_of(isa)), lowered_.features)),
          scratch_(kernels_.scratch_bytes(packed_.view(), 1))
    {
        job_.scene = &packed_.view();
        job_.camera = &camera_;
        job_.scratch = scratch_.data();
    }

    void trace_picture()
    {
        for (job_.y = 0; job_.y < size; job_.y += abi::tile_size)
            for (job_.x = 0; job_.x < size; job_.x += abi::tile_size) {
                kernels_.closest_tile(job_, hits_);
                benchmark::DoNotOptimize(hits_.t[0]);
            }
    }

private:
    LoweredScene lowered_;
    PackedScene<Real> packed_;
    abi::CameraView<Real> camera_;
    const abi::FeatureKernels<Real>& kernels_;
    AlignedArray<std::byte> scratch_;
    abi::TileJob<Real> job_;
    abi::TileHits<Real> hits_;
};

template <class Real>
void closest_hits(benchmark::State& state, const Scene& scene, const std::string& isa)
{
    ClosestHits<Real> tracer(scene, isa);
    for (auto _ : state)
        tracer.trace_picture();
    state.SetItemsProcessed(state.iterations() * size * size);
}

Scene sized(Scene scene)
{
    test::set_size(scene, size, size);
    return scene;
}

Scene planes_only()
{
    Scene scene = test::checkered_room(7);
    std::erase_if(scene.objects, [](const Object& object) {
        return std::holds_alternative<Sphere>(object.surface);
    });
    return sized(scene);
}

template <class Real>
void register_scene(const char* name, const Scene& scene)
{
    for (const std::string& isa : supported_isas())
        benchmark::RegisterBenchmark(
            benchmark_name({"closest", name, precision_name<Real>(), isa}).c_str(),
            [scene, isa](benchmark::State& state) { closest_hits<Real>(state, scene, isa); })
            ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_kernels()
{
    const std::pair<const char*, Scene> scenes[] = {
        {"four_spheres", test::four_spheres(size, size)},
        {"23_spheres", sized(test::random_spheres(23, 2))},
        {"6_planes", planes_only()},
    };
    for (const auto& [name, scene] : scenes) {
        register_scene<float>(name, scene);
        register_scene<double>(name, scene);
    }
}

}  // namespace packtrace::bench
