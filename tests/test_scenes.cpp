// Every scene in scenes/ with packets and with the scalar reference.
#include "catch.hpp"
#include "render_scene.hpp"
#include "same_bits.hpp"
#include "scene_files.hpp"
#include <packtrace/compare.hpp>

#include <tbb/global_control.h>

#include <filesystem>

namespace packtrace::test {
namespace {

namespace fs = std::filesystem;

std::string worst_pixel(const Comparison& comparison)
{
    if (comparison.worst.empty())
        return "none";
    return std::to_string(comparison.worst[0].x) + "," + std::to_string(comparison.worst[0].y);
}

}  // namespace

TEST_CASE("double packets equal the double and the long double reference on every scene",
          "[scenes]")
{
    for (const fs::path& file : scene_files()) {
        const Scene scene = small_or_deep_scene(file);
        const Image<double> reference = render_scalar<double>(scene);
        const auto truth = convert<double>(render_scalar<long double>(scene));
        for (const std::string& isa : supported_isas()) {
            const Image<double> packets = render_packets<double>(scene, isa);
            for (const Image<double>* expected : {&reference, &truth}) {
                const Comparison result = compare(packets, *expected);
                CAPTURE(file.filename().string(), isa, expected == &truth, worst_pixel(result));
                CHECK(result.max_abs < 1e-9);
            }
        }
    }
}

TEST_CASE("in full size four spheres differ from long double only where a ray is tangent",
          "[scenes][slow]")
{
    Scene scene = read_scene(fs::path(PACKTRACE_SOURCE_DIR) / "scenes/four_spheres.scene");
    set_size(scene, 640, 640);
    const auto truth = convert<double>(render_scalar<long double>(scene));
    const auto reference = render_scalar<double>(scene);
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        const Comparison doubles =
            compare(render_packets<double>(scene, isa), truth, {.threshold = 1e-9, .worst = 3});
        // Rays that touch a sphere to the last digit: half of the digits of t are certain there.
        CHECK(doubles.pixels_off <= 2);
        CHECK(doubles.max_abs < 1e-7);
        for (const PixelError& pixel : doubles.worst)
            if (pixel.error > 1e-9)
                CHECK((pixel.y == 255 && (pixel.x == 64 || pixel.x == 576)));
        const auto floats = convert<double>(render_packets<float>(scene, isa));
        CHECK(compare(floats, reference).pixels_off == 0);
    }
}

TEMPLATE_TEST_CASE("packets give one picture of every scene for all widths, traversals and threads",
                   "[scenes]", float, double)
{
    const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
    for (const fs::path& file : scene_files()) {
        const Scene scene = small_or_deep_scene(file);
        Image<TestType> first;
        for (const std::string& isa : fused_isas())
            for (const Traversal traversal : {Traversal::list, Traversal::tree})
                for (const int threads : {1, 2}) {
                    CAPTURE(file.filename().string(), isa, threads, static_cast<int>(traversal));
                    const RenderOptions options{
                        .isa = isa, .traversal = traversal, .threads = threads};
                    const Image<TestType> picture = render<TestType>(scene, options);
                    if (first.rgb.empty())
                        first = picture;
                    CHECK(same_bits(picture, first));
                }
    }
}

TEST_CASE("every scene shows something, in float too", "[scenes]")
{
    for (const fs::path& file : scene_files()) {
        CAPTURE(file.filename().string());
        const Scene scene = small_or_deep_scene(file);
        const Image<float> picture = render_packets<float>(scene, "auto");
        const auto [least, most] = std::minmax_element(picture.rgb.begin(), picture.rgb.end());
        CHECK(*most - *least > 0.25f);
        const Comparison result =
            compare(convert<double>(picture), render_scalar<double>(scene), {.threshold = 0.02});
        CHECK(static_cast<double>(result.pixels_off) < 0.01 * static_cast<double>(result.pixels));
    }
}

}  // namespace packtrace::test
