// Work on several threads: callbacks with tasks of their own, and the memory use of many short
// pieces of work.
#include "catch.hpp"
#include "peak_memory.hpp"
#include <packtrace/read_scene.hpp>
#include <packtrace/renderer.hpp>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

namespace packtrace::test {
namespace {

Scene ball(const std::string& size)
{
    return parse_scene("image_size = " + size + "  sphere { center = (0, 0, 3)  radius = 1 }",
                       "ball", {});
}

}  // namespace

TEST_CASE("A progress callback may wait for tasks of its own", "[threads]")
{
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
    const Scene scene = ball("256 x 256");
    RenderOptions options;
    int calls = 0;
    int within = 0;
    int most_within = 0;
    options.progress = [&](double) {
        ++calls;
        most_within = std::max(most_within, ++within);
        tbb::parallel_for(0, 64, [](int i) {
            volatile double sum = 0.0;
            for (int k = 0; k < 2000 * (i % 8); ++k)
                sum = sum + k;
        });
        --within;
    };
    for (int frame = 0; frame < 20; ++frame)
        (void)render<float>(scene, options);
    CHECK(calls >= 20);
    CHECK(most_within == 1);
}

TEST_CASE("Frames on a private number of threads leave no memory in use", "[threads]")
{
    const Renderer<float> renderer(ball("16 x 16"), {.threads = 2});
    Image<float> image;
    const auto render_often = [&] {
        for (int frame = 0; frame < 4000; ++frame)
            (void)renderer.render(image);
    };
    (void)renderer.render(image);
    const long growth = peak_growth(render_often);
    INFO(growth << " kB");
    CHECK(growth <= 4096 + sanitizer_kilobytes);
}

}  // namespace packtrace::test
