// Regions of a picture, and interrupted renders.
#include "catch.hpp"
#include "refusal.hpp"
#include "run_program.hpp"
#include "samplings.hpp"
#include "scenes.hpp"
#include "temp_folder.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/renderer.hpp>

#include <chrono>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace packtrace::test {
namespace {

constexpr const char* quadrics_file = PACKTRACE_SOURCE_DIR "/scenes/quadrics.scene";

Scene quadrics_of_size(int width, int height)
{
    Scene scene = read_scene(quadrics_file);
    set_size(scene, width, height);
    return scene;
}

template <class Real>
Image<Real> cut_out(const Image<Real>& whole, const Region& region)
{
    Image<Real> part(region.width, region.height);
    for (int row = 0; row < region.height; ++row)
        std::copy_n(whole.pixel(region.x, region.y + row), 3 * region.width, part.pixel(0, row));
    return part;
}

/// Corners, single pixels, whole tiles, edges of tiles and beside them, a column, everything.
std::vector<Region> regions_of(int width, int height)
{
    return {{0, 0, 1, 1},          {width - 1, height - 1, 1, 1},
            {16, 16, 16, 16},      {15, 15, 2, 2},
            {17, 3, 23, 30},       {width / 2, 0, 1, height},
            {0, 31, width, 3},     {5, 0, width - 5, height},
            {0, 0, width, height}, {32, 32, width - 32, 1}};
}

template <class Real>
void check_regions(const RenderOptions& options)
{
    const Scene scene = quadrics_of_size(61, 47);
    const Image<Real> whole = render<Real>(scene, options);
    for (const Region& region : regions_of(61, 47)) {
        CAPTURE(region.x, region.y, region.width, region.height);
        RenderOptions part = options;
        part.region = region;
        const Image<Real> image = render<Real>(scene, part);
        CHECK(image.width == region.width);
        CHECK(image.height == region.height);
        CHECK((image.rgb == cut_out(whole, region).rgb));
    }
}

std::string refusal_of_region(const Region& region, Kernel kernel)
{
    const RenderOptions options{.kernel = kernel, .region = region};
    return refusal<std::invalid_argument>(
        [&] { return render<float>(quadrics_of_size(64, 48), options); });
}

}  // namespace

TEST_CASE("a region of glass has the bits of the whole picture with adaptive sampling, too",
          "[region]")
{
    Scene scene = read_scene(PACKTRACE_SOURCE_DIR "/scenes/nested_glass.scene");
    set_size(scene, 96, 72);
    scene.max_depth = 5;
    const RenderOptions options{.samples = 16, .adaptive = 0.02};
    const Image<float> whole = render<float>(scene, options);
    for (const Region& region :
         {Region{40, 20, 20, 20}, Region{17, 0, 10, 16}, Region{33, 33, 30, 20}}) {
        CAPTURE(region.x, region.y);
        RenderOptions part = options;
        part.region = region;
        CHECK((render<float>(scene, part).rgb == cut_out(whole, region).rgb));
    }
}

TEST_CASE("a region has the pixels of the whole picture, bit for bit", "[region]")
{
    for (const Kernel kernel : {Kernel::packet, Kernel::scalar})
        for (auto [name, options] : samplings()) {
            options.kernel = kernel;
            CAPTURE(static_cast<int>(kernel), name);
            check_regions<float>(options);
            check_regions<double>(options);
        }
}

TEST_CASE("a renderer fits its image to the region, and counts its tiles' rays", "[region]")
{
    const Scene scene = quadrics_of_size(64, 48);
    const RenderOptions options{.region = Region{20, 20, 4, 4}};
    Image<float> image;
    const FrameCounts counts = Renderer<float>(scene, options).render(image);
    CHECK(image.width == 4);
    CHECK(counts.camera == 16 * 16);
}

TEST_CASE("a renderer resizes an image whose pixels were moved away", "[region]")
{
    const Renderer<float> renderer(quadrics_of_size(40, 30), {});
    std::vector<Image<float>> frames;
    Image<float> image;
    for (int i = 0; i < 3; ++i) {
        (void)renderer.render(image);
        frames.push_back(std::move(image));
    }
    CHECK(frames[0].rgb == frames[2].rgb);
    // NOLINTNEXTLINE(bugprone-use-after-move): it keeps its sides, which is what is tested.
    image.rgb.resize(5);
    (void)renderer.render(image);
    CHECK(image.rgb == frames[0].rgb);
}

TEST_CASE("a region outside the picture is refused", "[region]")
{
    for (const Kernel kernel : {Kernel::packet, Kernel::scalar}) {
        CHECK(refusal_of_region({60, 0, 5, 1}, kernel) ==
              "region: 5 x 1 pixels from (60, 0) on are not within the picture of 64 x 48; stay "
              "inside it");
        for (const Region& region : {Region{-1, 0, 2, 2}, Region{0, 0, 0, 1}, Region{0, 0, 1, -1},
                                     Region{0, 48, 1, 1}, Region{1, 0, 2147483647, 1}})
            CHECK_THAT(refusal_of_region(region, kernel), ContainsSubstring("are not within"));
    }
}

TEST_CASE("rendering stops when asked to", "[region]")
{
    const Scene scene = quadrics_of_size(640, 480);
    for (const Kernel kernel : {Kernel::packet, Kernel::scalar})
        for (auto [name, options] : samplings()) {
            CAPTURE(static_cast<int>(kernel), name);
            std::stop_source source;
            double reached = 0.0;
            options.kernel = kernel;
            options.threads = 1;
            options.stop = source.get_token();
            options.progress = [&](double share) {
                reached = share;
                source.request_stop();
            };
            CHECK_THROWS_AS((void)render<float>(scene, options), StopError);
            CHECK(reached > 0.0);
            CHECK(reached < 0.1);
            // The callback is asked before rendering begins.
            CHECK_THROWS_AS((void)render<float>(scene, options), StopError);
        }
}

TEST_CASE("another thread can stop a render", "[region]")
{
    std::stop_source source;
    const RenderOptions options{.samples = 1024, .stop = source.get_token()};
    const std::jthread stopper([&] { source.request_stop(); });
    CHECK_THROWS_AS((void)render<float>(quadrics_of_size(1024, 1024), options), StopError);
}

TEST_CASE("the scalar kernel stops within a row", "[region]")
{
    double reached = 0.0;
    std::stop_source source;
    const RenderOptions options{.kernel = Kernel::scalar,
                                .samples = 256,
                                .progress = [&](double share) { reached = share; },
                                .stop = source.get_token()};
    const std::jthread stopper([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        source.request_stop();
    });
    // A row is reported when it is done.
    CHECK_THROWS_AS((void)render<float>(quadrics_of_size(65536, 1), options), StopError);
    CHECK(reached == 0.0);
}

TEST_CASE("render --region writes a part of the picture", "[region]")
{
    const TempFolder folder;
    const auto run = [&](const std::vector<std::string>& more, const std::string& name) {
        std::vector<std::string> words{"render", quadrics_file,           "--size", "64x48", "-q",
                                       "-o",     (folder / name).string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_packtrace(words);
    };
    CHECK(run({}, "whole.pfm").exit_code == 0);
    CHECK(run({"--region", "10,7,30,20"}, "part.pfm").exit_code == 0);
    const Image<float> whole = read_image(folder / "whole.pfm");
    const Image<float> part = read_image(folder / "part.pfm");
    CHECK((part.rgb == cut_out(whole, {10, 7, 30, 20}).rgb));
    CHECK(part.width == 30);

    const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
        const ProgramResult result = run(more, "none.pfm");
        CHECK(result.exit_code == 2);
        CHECK_THAT(result.err, ContainsSubstring(why));
        CHECK_FALSE(std::filesystem::exists(folder / "none.pfm"));
    };
    refused({"--region", "10,7,30"}, "is not a region such as");
    refused({"--region", "10,7,30,20,"}, "is not a region such as");
    refused({"--region", "1e1,7,30,20"}, "is not a region such as");
    refused({"--region", "40,7,30,20"}, "--region: 30 x 20 pixels from (40, 7) on are not within");
    refused({"--region", "0,0,9,9", "--resume"}, "can't be resumed");
    refused({"--region", "0,0,9,9", "--certainty", (folder / "c.png").string()},
            "of whole pictures");
}

}  // namespace packtrace::test
