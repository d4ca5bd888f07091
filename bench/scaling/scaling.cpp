// packtrace_scaling: one point of a scaling study, as JSON: building and rendering random spheres.
// Each point has its own process, so that it has its own peak of memory.
#include "context.hpp"
#include "core/seconds_since.hpp"
#include "program.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/renderer.hpp>

#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <malloc.h>
#include <sys/resource.h>

namespace packtrace {
namespace {

struct Arguments {
    int objects = 1000;
    int size = 1024;
    int threads = 1;
    int frames = 5;
    double cover = 1.0;
};

double allocated_bytes()
{
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

double peak_bytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Spheres in the unit cube with the same total cross-section for every number of spheres, so that
/// about as many rays hit them.
Scene scene_of(const Arguments& arguments)
{
    const double radius = std::sqrt(arguments.cover / arguments.objects);
    Scene scene = generate_random_spheres({.count = arguments.objects, .radius = radius});
    scene.width = scene.height = arguments.size;
    return scene;
}

nlohmann::ordered_json measure(const Arguments& arguments)
{
    const Scene scene = scene_of(arguments);
    const RenderOptions options{.threads = arguments.threads};
    nlohmann::ordered_json point{
        {"objects", arguments.objects}, {"size", arguments.size}, {"threads", arguments.threads}};
    const double before = allocated_bytes();
    auto start = std::chrono::steady_clock::now();
    const Renderer<float> renderer(scene, options);
    point["build_seconds"] = seconds_since(start);
    point["build_bytes_an_object"] = (allocated_bytes() - before) / arguments.objects;
    point["scene_bytes_an_object"] =
        static_cast<double>(renderer.scene_bytes()) / arguments.objects;
    Image<float> image;
    for (int frame = 0; frame < arguments.frames; ++frame) {
        start = std::chrono::steady_clock::now();
        const FrameCounts counts = renderer.render(image);
        point["frame_seconds"].push_back(seconds_since(start));
        point["rays"] = {{"camera", counts.camera},
                         {"shadow", counts.shadow},
                         {"reflected", counts.reflected},
                         {"total", counts.total()}};
    }
    point["peak_bytes"] = peak_bytes();
    return point;
}

void print_point(const Arguments& arguments)
{
    // Limits the build; frames have the number of threads in their options.
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(arguments.threads));
    nlohmann::ordered_json point = measure(arguments);
    point["context"] = bench::context_json();
    std::cout << point.dump() << '\n';
}

void add_options(bench::Program& program, Arguments& arguments)
{
    program.number("--objects", arguments.objects, {1, 10'000'000},
                   "Random spheres (default 1000)");
    program.number("--size", arguments.size, {1, 65536}, "Pixels of each edge (default 1024)");
    program.number("--threads", arguments.threads, {1, 1024}, "Threads (default 1)");
    program.number("--frames", arguments.frames, {1, 1000}, "Frames (default 5)");
    program.number("--cover", arguments.cover, {1e-9, 1e3},
                   "Squares of all radii together (default 1)");
}

}  // namespace
}  // namespace packtrace

int main(int argc, char** argv)
{
    packtrace::bench::Program program("packtrace_scaling", "One point of a scaling study, as JSON");
    packtrace::Arguments arguments;
    packtrace::add_options(program, arguments);
    return program.run(argc, argv, [&] { packtrace::print_point(arguments); });
}
