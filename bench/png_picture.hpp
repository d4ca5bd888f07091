#pragma once

#include <packtrace/read_scene.hpp>
#include <packtrace/renderer.hpp>

#include <benchmark/benchmark.h>

namespace packtrace::bench {

/// Note 001's scene at 1024 x 1024.
inline const Scene& scene()
{
    static const Scene scene = [] {
        Scene read = read_scene(PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene");
        read.width = 1024;
        read.height = 1024;
        return read;
    }();
    return scene;
}

/// The picture of that scene.
inline const Image<float>& picture()
{
    static const Image<float> image = [] {
        Image<float> rendered;
        static_cast<void>(Renderer<float>(scene()).render(rendered));
        return rendered;
    }();
    return image;
}

inline void use_wall_and_cpu_time(benchmark::internal::Benchmark* bench)
{
    bench->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
}

inline void count(benchmark::State& state, std::size_t bytes)
{
    state.SetItemsProcessed(state.iterations() * 1024 * 1024);
    state.counters["file_bytes"] = static_cast<double>(bytes);
}

}  // namespace packtrace::bench
