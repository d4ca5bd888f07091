// What lies exactly where something begins: hits in the plane of projection, rays along and on
// surfaces.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include <tbb/global_control.h>

#include "catch.hpp"
#include "lab/soak/soak.hpp"

namespace packtrace::test {
namespace {

std::vector<RenderOptions> packet_ways()
{
    std::vector<RenderOptions> ways;
    for (const IsaInfo& isa : list_isas())
        for (const Traversal traversal : {Traversal::list, Traversal::tree})
            for (const Accuracy accuracy : {Accuracy::exact, Accuracy::fast})
                if (isa.supported) {
                    RenderOptions options;
                    options.isa = isa.name;
                    options.traversal = traversal;
                    options.accuracy = accuracy;
                    ways.push_back(options);
                }
    return ways;
}

template <class Real>
double largest_difference(const Image<Real>& image, const Image<double>& truth)
{
    REQUIRE(image.rgb.size() == truth.rgb.size());
    double most = 0.0;
    for (std::size_t i = 0; i < truth.rgb.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(image.rgb[i]) - truth.rgb[i]));
    return most;
}

}  // namespace

TEST_CASE("What lies in the plane of projection is seen", "[coincidences]")
{
    // Note 001 looks for t from 1 on: the wall is at t = 1 in all of the picture.
    const Scene scene = parse_scene(R"(
        illumination = scratch
        image_size = 8 x 8
        background = (255, 255, 255)
        light { type = ambient  intensity = 1 }
        plane { point = (0, 0, 1)  normal = (0, 0, -1)  color = (255, 0, 0) }
    )",
                                    "wall", {});
    const Image<double> truth = render<double>(scene, {.kernel = Kernel::scalar});
    CHECK(truth.rgb[0] == 1.0);
    CHECK(truth.rgb[1] == 0.0);
    for (const RenderOptions& options : packet_ways()) {
        INFO(options.isa);
        CHECK(largest_difference(render<double>(scene, options), truth) == 0.0);
        CHECK(largest_difference(render<float>(scene, options), truth) == 0.0);
    }
}

TEST_CASE("A ray that only touches the sphere it starts on meets it in no query", "[coincidences]")
{
    const Scene scene = parse_scene("sphere { center = (0, 2, 1)  radius = 1 }", "ball", {});
    const Ray<double> ray{{-0.0, 2, 0}, {0.12511034345577374, -0.25022068691154747, 0}};
    for (const RenderOptions& options : packet_ways()) {
        INFO(options.isa);
        const RayScene<double> rays(scene, options);
        CHECK(rays.closest_hit(ray).object == -1);
        CHECK_FALSE(rays.occluded(ray));
        CHECK(rays.all_hits(ray).empty());
    }
}

TEST_CASE("Scenes of much that coincides have the same bits in every way", "[coincidences]")
{
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 3);
    lab::SoakOptions options;
    options.scenes = 96;
    options.aligned = true;
    std::string findings;
    const lab::SoakCounts counts = lab::run_soak(options, [&](const lab::SoakReport& report) {
        findings += std::to_string(report.number) + ": " + report.finding.what + "\n";
    });
    CHECK(findings == "");
    CHECK(counts.scenes == 96);
    CHECK(counts.refused < 48);
}

}  // namespace packtrace::test
