// packtrace_scaling: one point of a scaling study, as JSON: building and frames of random
// spheres. A process a point, so that its peak of memory is its own.
#include <malloc.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <packtrace/generate.hpp>
#include <packtrace/renderer.hpp>

#include <tbb/global_control.h>

#include "context.hpp"
#include "core/seconds_since.hpp"
#include "program.hpp"

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

/// Spheres in the unit cube whose cross-sections add up to the same area, however many they
/// are, so that as many rays hit and scenes differ in their grain alone.
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
    // Building runs in what threads there are, frames in what the options say.
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(arguments.threads));
    nlohmann::ordered_json point = measure(arguments);
    point["context"] = bench::context_json();
    std::cout << point.dump() << '\n';
}

void add_options(CLI::App& app, Arguments& arguments)
{
    app.add_option("--objects", arguments.objects, "Random spheres (default 1000)")
        ->check(CLI::Range(1, 10'000'000));
    app.add_option("--size", arguments.size, "Pixels of each edge (default 1024)")
        ->check(CLI::Range(1, 65536));
    app.add_option("--threads", arguments.threads, "Threads (default 1)")
        ->check(CLI::Range(1, 1024));
    app.add_option("--frames", arguments.frames, "Frames (default 5)")->check(CLI::Range(1, 1000));
    app.add_option("--cover", arguments.cover, "Squares of all radii together (default 1)")
        ->check(CLI::Range(1e-9, 1e3));
}

}  // namespace
}  // namespace packtrace

int main(int argc, char** argv)
{
    CLI::App app{"One point of a scaling study, as JSON"};
    packtrace::Arguments arguments;
    packtrace::add_options(app, arguments);
    return packtrace::bench::run_program(app, "packtrace_scaling", argc, argv,
                                         [&] { packtrace::print_point(arguments); });
}
