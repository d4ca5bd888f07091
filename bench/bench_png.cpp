// The cost of writing a picture beside rendering it: note 001's scene at 1024 x 1024.
#include "image/formats.hpp"
#include "png_picture.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/renderer.hpp>

#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

namespace packtrace {
namespace {

using namespace bench;

// Rendering, to compare the writers below with; argument: threads.
void render_frame(benchmark::State& state)
{
    const Renderer<float> renderer(scene(), {.threads = static_cast<int>(state.range(0))});
    Image<float> image;
    for (auto _ : state)
        benchmark::DoNotOptimize(renderer.render(image));
    state.SetItemsProcessed(state.iterations() * 1024 * 1024);
}
BENCHMARK(render_frame)->Arg(1)->Arg(2)->Apply(use_wall_and_cpu_time);

// write_image() as a whole, into a file.
void write_png(benchmark::State& state)
{
    const auto file = std::filesystem::temp_directory_path() / "packtrace_bench.png";
    for (auto _ : state)
        write_image(file, picture());
    count(state, std::filesystem::file_size(file));
    std::filesystem::remove(file);
}
BENCHMARK(write_png)->Apply(use_wall_and_cpu_time);

// Encoding without writing: the whole picture by stb_image_write (0), or row by row by libpng (1).
void encode_png_bytes(benchmark::State& state)
{
    PngSettings settings;
    if (state.range(0) == 1)
        settings.largest_whole = 0;
    std::size_t bytes = 0;
    for (auto _ : state)
        bytes = encode_png(picture(), settings).size();
    count(state, bytes);
}
BENCHMARK(encode_png_bytes)->ArgName("rows")->Arg(0)->Arg(1)->Apply(use_wall_and_cpu_time);

}  // namespace
}  // namespace packtrace
