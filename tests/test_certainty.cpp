// Rays that single precision is unsure of: by pixel, by cause, and which requests are refused.
#include "catch.hpp"
#include "memory_limit.hpp"
#include "run_program.hpp"
#include "scenes.hpp"
#include "temp_folder.hpp"
#include <packtrace/certainty.hpp>
#include <packtrace/image_io.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/renderer.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace packtrace::test {
namespace {

enum CauseNumber : std::size_t { tangent, order, range, clip, magnitude };

/// A line of scene text.
template <class... Words>
std::string line_of(const Words&... words)
{
    std::ostringstream text;
    text.precision(17);
    (text << ... << words) << '\n';
    return text.str();
}

/// Balls that the camera rays of the middle column touch, each in one point.
std::string touched_balls(int number)
{
    std::string text;
    for (int i = 1; i <= number; ++i)
        for (const int side : {-1, 1})
            text += line_of("sphere { center = (0.015625, ", side * i / 16.0, ", 6)",
                            "  radius = 0.015625  color = (200, 90, 9)  reflective = 0.3 }");
    return text;
}

/// Drums whose front rims camera rays hit. They stand behind each other; each appears a pixel wider
/// than the one in front.
std::string drums(int number)
{
    std::string text;
    for (int i = 1; i <= number; ++i) {
        const double front = 4.0 + i / 4.0;
        const double radius = front * i / 32.0;
        text +=
            line_of("cylinder { z_range = (-1, 1)  capped = true  scale = (", radius, ", ", radius,
                    ", 1)  translate = (0, 0, ", front + 1.0, ")  color = (200, 90, 9) }");
    }
    return text;
}

/// A grid of `edge` by `edge` balls.
std::string balls(int edge)
{
    std::string text;
    for (int i = 0; i < edge * edge; ++i)
        text += "sphere { center = (" + std::to_string(i % edge - edge / 2) + ", " +
                std::to_string(i / edge - edge / 2) +
                ", 6)  radius = 0.45  color = (200, 90, 9)  "
                "reflective = 0.3 }\n";
    return text;
}

Scene scene_of(const std::string& text)
{
    Scene scene = parse_scene(text, "scene");
    set_size(scene, 96, 96);
    return scene;
}

const std::string lights =
    "light { type = point  position = (3, 5, -4)  intensity = 0.6 }\n"
    "light { type = directional  direction = (1, 4, -2)  intensity = 0.3 }\n";

/// Two nearly equal balls: where a ray hits both, rounding decides which is first.
const std::string twins =
    "sphere { center = (0, 0, 6)  radius = 1  color = (200, 90, 9) }\n"
    "sphere { center = (0, 0, 6)  radius = 1.0000000000000002  color = (9, 90, 200) }\n";

std::uint64_t sum_of(const UnsureCounts& counts)
{
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

PixelCertainty sum_of(const std::vector<PixelCertainty>& pixels)
{
    PixelCertainty sum;
    for (const PixelCertainty& pixel : pixels) {
        sum.rays += pixel.rays;
        sum.unsure += pixel.unsure;
        sum.undecided += pixel.undecided;
    }
    return sum;
}

/// The number of rays that the kernels for streams trace again. The kernels with probes use streams
/// too; paths in registers have other error bounds.
std::uint64_t unsure_in_frame(const Scene& scene, RenderOptions options)
{
    options.force_general = true;
    Image<float> image;
    return Renderer<float>(scene, options).render(image).unsure;
}

bool same_pixels(const Certainty& a, const Certainty& b)
{
    return std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), b.pixels.end(),
                      [](const PixelCertainty& x, const PixelCertainty& y) {
                          return x.rays == y.rays && x.unsure == y.unsure &&
                                 x.undecided == y.undecided;
                      });
}

}  // namespace

TEST_CASE("the rays traced again are those of the frame, by lists and by a bvh", "[certainty]")
{
    for (const std::string& objects : {touched_balls(4), twins, touched_balls(40), drums(9)})
        for (const IsaInfo& isa : list_isas()) {
            if (!isa.supported)
                continue;
            for (const Traversal traversal : {Traversal::list, Traversal::tree}) {
                const RenderOptions options{.isa = isa.name, .traversal = traversal};
                const Scene scene = scene_of(objects + lights);
                CAPTURE(isa.name, scene.objects.size(), traversal == Traversal::tree);
                const Certainty certainty = find_certainty(scene, options);
                const std::uint64_t unsure = sum_of(certainty.unsure);
                CHECK(unsure > 0);
                CHECK(unsure == certainty.rays.unsure);
                CHECK(unsure == unsure_in_frame(scene, options));
                const PixelCertainty pixels = sum_of(certainty.pixels);
                CHECK(pixels.unsure == unsure);
                CHECK(pixels.undecided == certainty.undecided);
                // Certainty omits camera rays of tiles without a hit.
                CHECK(pixels.rays <= certainty.rays.total());
                CHECK(pixels.rays + certainty.rays.camera >= certainty.rays.total());
                for (const PixelCertainty& pixel : certainty.pixels) {
                    REQUIRE(pixel.unsure <= pixel.rays);
                    REQUIRE(pixel.undecided <= pixel.unsure);
                }
            }
        }
}

TEST_CASE("a pixel counts every ray of its tree", "[certainty]")
{
    // One pixel: a camera ray, its shadow rays, a mirrored ray and the rays of its hit.
    Scene scene = scene_of(
        "sphere { center = (0, 0, 6)  radius = 4  color = (200, 90, 9)  reflective = 0.5 }\n" +
        lights);
    set_size(scene, 1, 1);
    const Certainty certainty = find_certainty(scene);
    REQUIRE(certainty.pixels.size() == 1);
    CHECK(certainty.pixels[0].rays == certainty.rays.total());
    CHECK(certainty.rays.shadow > 0);
    CHECK(certainty.rays.reflected > 0);
}

TEST_CASE("certainty does not depend on the number of threads", "[certainty]")
{
    const Scene scene = scene_of(balls(12) + lights);
    RenderOptions options{.threads = 1};
    const Certainty one = find_certainty(scene, options);
    options.threads = 4;
    CHECK(same_pixels(one, find_certainty(scene, options)));
}

TEST_CASE("pixels with several samples have several times the rays", "[certainty]")
{
    const Scene scene = scene_of(balls(5) + lights);
    RenderOptions options;
    const Certainty once = find_certainty(scene, options);
    options.samples = 4;
    const Certainty more = find_certainty(scene, options);
    CHECK(more.rays.camera == 4 * once.rays.camera);
    CHECK(sum_of(more.pixels).rays > 3 * sum_of(once.pixels).rays);
    CHECK(sum_of(more.pixels).unsure == more.rays.unsure);
}

TEST_CASE("single precision is unsure for five causes, and a scene shows each", "[certainty]")
{
    const auto counts = [](const std::string& objects, const std::string& more = lights) {
        return find_certainty(scene_of(objects + more)).unsure;
    };
    // Silhouettes.
    CHECK(counts(touched_balls(40))[tangent] > 20);
    // Two planes that differ by less than a rounding error.
    const auto planes = counts(
        "plane { point = (0, -1, 0)  normal = (0, 1, 0)  color = (9, 9, 9) }\n"
        "plane { point = (0, -1.00000001, 0)  normal = (0, 1, 0)  color = (200, 9, 9) }\n");
    CHECK(planes[order] > 1000);
    CHECK(counts(twins)[order] > 500);
    // A light exactly on the surface of a ball: its shadow rays end on the surface.
    CHECK(counts("plane { point = (0, -1, 0)  normal = (0, 1, 0)  color = (9, 9, 9) }\n"
                 "sphere { center = (0, 2, 6)  radius = 1  color = (200, 90, 9) }\n",
                 "light { type = point  position = (0, 1, 6)  intensity = 1 }\n")[range] > 100);
    // Rims.
    CHECK(counts(drums(9))[clip] > 10);
    // Sizes beyond the proven range: every ray goes to double.
    const Certainty far = find_certainty(
        scene_of("sphere { center = (0, 0, 6)  radius = 1  color = (9, 9, 9) }\n"
                 "sphere { center = (0, -1e12, 0)  radius = 1e11  color = (9, 9, 9) }\n" +
                 lights));
    CHECK(far.unsure[magnitude] > 0);
    CHECK(far.unsure[magnitude] == sum_of(far.unsure));
}

TEST_CASE("double cannot decide between surfaces that are a rounding error apart", "[certainty]")
{
    const Certainty apart = find_certainty(scene_of(twins + lights));
    CHECK(apart.undecided > 0);
    // Double decides what single precision alone cannot.
    const Certainty clear = find_certainty(scene_of(
        "plane { point = (0, -1, 0)  normal = (0, 1, 0)  color = (9, 9, 9) }\n"
        "plane { point = (0, -1.00000001, 0)  normal = (0, 1, 0)  color = (200, 9, 9) }\n" +
        lights));
    CHECK(sum_of(clear.unsure) > 1000);
    CHECK(clear.undecided == 0);
}

TEST_CASE("the picture shows both shares of each pixel", "[certainty]")
{
    Certainty certainty;
    certainty.width = 3;
    certainty.height = 1;
    certainty.pixels = {{0, 0, 0}, {4, 1, 0}, {8, 6, 2}};
    const Image<float> picture = certainty_picture(certainty);
    REQUIRE(picture.width == 3);
    const std::vector<float> expected{0, 0, 0, 0.25f, 0, 0, 0.75f, 0, 0.25f};
    CHECK(std::equal(expected.begin(), expected.end(), picture.rgb.begin(), picture.rgb.end()));
}

TEST_CASE("requests that have no unsure rays are refused", "[certainty]")
{
    Certainty more;
    more.width = more.height = 1;
    more.pixels.resize(2);
    CHECK_THROWS_AS(certainty_picture(more), std::invalid_argument);
    const Scene scene = four_spheres(16, 16);
    RenderOptions options{.kernel = Kernel::scalar};
    CHECK_THROWS_AS(find_certainty(scene, options), std::invalid_argument);
    options = {};
    options.accuracy = Accuracy::fast;
    CHECK_THROWS_AS(find_certainty(scene, options), std::invalid_argument);
    options = {};
    options.samples = 4;
    options.adaptive = 0.1;
    CHECK_THROWS_AS(find_certainty(scene, options), std::invalid_argument);
}

TEST_CASE("render paints certainty beside the picture", "[certainty]")
{
    const TempFolder folder;
    const std::string scene = (folder / "a.scene").string();
    write_text(scene, twins + lights);
    const auto at = [&](const char* name) { return (folder / name).string(); };
    const auto render = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"render", scene, "-o", at("a.pfm"), "--size", "64x48"};
        words.insert(words.end(), more.begin(), more.end());
        return run_packtrace(words);
    };
    CHECK(render({"-q"}).exit_code == 0);
    const std::string alone = read_text(at("a.pfm"));
    const ProgramResult result = render({"--certainty", at("c.pfm")});
    CHECK(result.exit_code == 0);
    CHECK(read_text(at("a.pfm")) == alone);
    CHECK_THAT(result.err, ContainsSubstring("c.pfm: red, traced again in double: "));
    CHECK_THAT(result.err, ContainsSubstring("blue, undecided by double, too: "));
    const Image<float> picture = read_image(at("c.pfm"));
    CHECK(picture.width == 64);
    CHECK(picture.height == 48);
    CHECK(std::any_of(picture.rgb.begin(), picture.rgb.end(), [](float x) { return x > 0; }));
    CHECK(render({"-q", "--certainty", at("c.png"), "--threads", "2"}).err.empty());
    CHECK(read_image(at("c.png")).width == 64);

    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--kernel", "scalar"},
                                                  {"--precision", "double"},
                                                  {"--accuracy", "fast"},
                                                  {"--adaptive", "0.1"},
                                                  {"--certainty", at("a.pfm")},
                                                  {"--certainty", at("none/c.pfm")},
                                                  {"--certainty", at("c.txt")}}) {
        CAPTURE(wrong);
        std::vector<std::string> words{"render", scene, "-o", at("b.pfm"), "--size", "64x48"};
        if (wrong[0] != "--certainty")
            words.insert(words.end(), {"--certainty", at("d.pfm")});
        if (wrong[1] == at("a.pfm"))
            words[3] = at("a.pfm");
        words.insert(words.end(), wrong.begin(), wrong.end());
        const ProgramResult refused = run_packtrace(words);
        CHECK(refused.exit_code != 0);
        CHECK(std::count(refused.err.begin(), refused.err.end(), '\n') <= 2);
        CHECK_FALSE(std::filesystem::exists(at("b.pfm")));
        CHECK_FALSE(std::filesystem::exists(at("d.pfm")));
    }
}

TEST_CASE("certainty of a picture too large for memory is refused before the picture is rendered",
          "[certainty]")
{
    const std::string limit = memory_limit(4'000'000);
    if (limit.empty())
        return;
    const TempFolder folder;
    const std::string picture = (folder / "a.png").string();
    const ProgramResult result =
        run_packtrace({"render", four_spheres_file, "--size", "20000x10000", "-o", picture,
                       "--certainty", (folder / "c.png").string()},
                      limit);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.err, ContainsSubstring(
                               "--certainty: 20000 x 10000 pixels take 7.2 GB of memory, of which "
                               "there are 4.1 GB; give a smaller --size or leave it out"));
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK(folder.names().empty());
}

TEST_CASE("info counts unsure rays of a small picture", "[certainty]")
{
    const TempFolder folder;
    const std::string scene = (folder / "a.scene").string();
    write_text(scene, twins + lights);
    const ProgramResult text = run_packtrace({"info", scene});
    CHECK(text.exit_code == 0);
    CHECK_THAT(text.out, ContainsSubstring(" rays of a 128 x 128 picture: "));
    CHECK_THAT(text.out, ContainsSubstring("order "));
    const auto json = nlohmann::json::parse(run_packtrace({"info", scene, "--json"}).out);
    const auto& unsure = json["scene"]["unsure"];
    CHECK(unsure["width"] == 128);
    CHECK(unsure["order"].get<int>() > 0);
    CHECK(unsure["rays"].get<int>() >= 128 * 128);
}

}  // namespace packtrace::test
