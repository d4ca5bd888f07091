// Every scene in scenes/ with packets and with the scalar reference.
#include <cstring>
#include <filesystem>

#include <tbb/global_control.h>
#include <packtrace/compare.hpp>

#include "catch.hpp"
#include "render_scene.hpp"
#include "scene_files.hpp"

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

TEST_CASE("double packets equal the double reference on every scene", "[scenes]")
{
    for (const fs::path& file : scene_files()) {
        const Scene scene = small_scene(file);
        const Image<double> truth = render_scalar<double>(scene);
        for (const std::string& isa : supported_isas()) {
            const Comparison result = compare(render_packets<double>(scene, isa), truth);
            CAPTURE(file.filename().string(), isa, worst_pixel(result));
            CHECK(result.max_abs < 1e-9);
        }
    }
}

TEST_CASE("float packets give one picture of every scene for all widths and threads", "[scenes]")
{
    const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
    for (const fs::path& file : scene_files()) {
        const Scene scene = small_scene(file);
        Image<float> first;
        for (const std::string& isa : fused_isas())
            for (const int threads : {1, 2}) {
                CAPTURE(file.filename().string(), isa, threads);
                const Image<float> picture = render_packets<float>(scene, isa, threads);
                if (first.rgb.empty())
                    first = picture;
                CHECK(std::memcmp(picture.rgb.data(), first.rgb.data(),
                                  first.rgb.size() * sizeof(float)) == 0);
            }
    }
}

TEST_CASE("every scene shows something, in float too", "[scenes]")
{
    for (const fs::path& file : scene_files()) {
        CAPTURE(file.filename().string());
        const Scene scene = small_scene(file);
        const Image<float> picture = render_packets<float>(scene, "auto");
        const auto [least, most] = std::minmax_element(picture.rgb.begin(), picture.rgb.end());
        CHECK(*most - *least > 0.25f);
        const Comparison result =
            compare(convert<double>(picture), render_scalar<double>(scene), {.threshold = 0.02});
        CHECK(static_cast<double>(result.pixels_off) < 0.01 * static_cast<double>(result.pixels));
    }
}

}  // namespace packtrace::test
