// Scene::min_weight: the rays that are not traced, and the error of a picture without them.
#include "catch.hpp"
#include "feature_scenes.hpp"
#include "packet_scenes.hpp"
#include "packet_ways.hpp"
#include "render_scene.hpp"
#include "run_program.hpp"
#include "scene_files.hpp"
#include "scene_text.hpp"
#include "temp_folder.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/renderer.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

/// A pixel's sum is rounded differently if some of its terms are missing.
template <class Real>
constexpr double rounding = sizeof(Real) == sizeof(float) ? 2e-5 : 1e-13;

template <class Real>
struct CutPicture {
    Image<Real> image;
    CutRays cut;
};

template <class Real>
CutPicture<Real> render_cut(const Scene& scene, double min_weight,
                            const RenderOptions& options = {})
{
    CutPicture<Real> picture;
    picture.image = render<Real>(changed(scene, [&](Scene& s) { s.min_weight = min_weight; }),
                                 options, &picture.cut);
    return picture;
}

RenderOptions scalar_options()
{
    return {.kernel = Kernel::scalar};
}

/// Every note's model, mirrors and glass of every kind, and light beyond the usual bounds.
std::vector<NamedScene> bouncing_scenes()
{
    std::vector<NamedScene> scenes = packet_scenes();
    for (const char* file :
         {"general", "mirror_room", "nested_glass", "sketch", "transparent_shadows", "whitted"}) {
        Scene scene = read_scene(PACKTRACE_SOURCE_DIR "/scenes/" + std::string(file) + ".scene");
        set_size(scene, 40, 30);
        scenes.push_back({file, scene});
    }
    const std::string view = "image_size = 40 x 30\nbackground = (200, 100, 50)\n";
    const std::string light =
        "light { type = ambient intensity = (0.3, 0.2, 0.9) }\n"
        "light { type = point intensity = (3, 0.5, 1) position = (2, 3, -1) }\n";
    scenes.push_back(
        {"glass and mirrors that make more of light",
         parse(view + light +
               "illumination = general\nmax_depth = 5\nshadows = transparent\n"
               "sphere { center = (0, 0, 4) radius = 1 transmit = (1.5, 0.2, 0.3) ior = 1.3\n"
               "         reflect = (0.01, 1.2, 0.1) highlight = 2 shininess = 30 }\n"
               "sphere { center = (0.4, 1.2, 3) radius = 0.4 transmit = (0.1, 1.6, 0.3) }\n"
               "plane { point = (0, -1, 0) normal = (0, 1, 0) diffuse = 0.7 reflect = 0.02 }\n")});
    scenes.push_back(
        {"a colour at the depth limit",
         parse(view + light +
               "illumination = general\nmax_depth = 3\ndepth_limit = background\n"
               "sphere { center = (-1, 0, 4) radius = 1 reflect = (0.3, 0.02, 0.1) }\n"
               "sphere { center = (1, 0, 4) radius = 1 reflect = 0.4 transmit = 0.05 }\n")});
    return scenes;
}

template <class Real>
void check_bound(const NamedScene& named, const RenderOptions& options)
{
    const Image<Real> whole = render<Real>(named.scene, options);
    for (const double weight : {0.25, 0.03, 0.004}) {
        const CutPicture<Real> picture = render_cut<Real>(named.scene, weight, options);
        CAPTURE(named.name, weight, picture.cut.rays, picture.cut.bound);
        const double difference = largest_difference(picture.image, convert<double>(whole));
        CHECK(difference <= picture.cut.bound * (1.0 + rounding<Real>)+rounding<Real>);
        if (picture.cut.rays > 0)
            continue;
        CHECK(picture.cut.bound == 0.0);
        CHECK((picture.image.rgb == whole.rgb));
    }
}

}  // namespace

TEST_CASE("no pixel's error exceeds the bound of the rays that are not traced", "[min_weight]")
{
    for (const NamedScene& named : bouncing_scenes()) {
        check_bound<float>(named, {});
        check_bound<double>(named, {});
        check_bound<float>(named, scalar_options());
    }
}

TEST_CASE("the bound holds where a pixel has several samples", "[min_weight]")
{
    for (const NamedScene& named : bouncing_scenes()) {
        RenderOptions options{.samples = 4};
        check_bound<float>(named, options);
        options.kernel = Kernel::scalar;
        check_bound<double>(named, options);
    }
}

TEST_CASE("a single cut ray that carries all of the light attains the bound", "[min_weight]")
{
    const Scene scene = parse(
        "image_size = 9 x 9\nillumination = general\nmax_depth = 2\n"
        "background = rgb(0.5, 0.25, 0.75)\n"
        "sphere { center = (0, 0, 3) radius = 1 reflect = (0.01, 0.002, 0.008) }\n");
    for (const bool scalar : {false, true}) {
        const RenderOptions options = scalar ? scalar_options() : RenderOptions{};
        const CutPicture<double> picture = render_cut<double>(scene, 0.02, options);
        CHECK(picture.cut.rays > 0);
        CHECK(picture.cut.bound == Approx(0.008 * 0.75).epsilon(1e-4));
        const double difference = largest_difference(picture.image, render<double>(scene, options));
        CHECK(difference == Approx(0.008 * 0.75).epsilon(1e-12));
        // A ray whose weight equals min_weight is traced.
        CHECK(render_cut<double>(scene, 0.01, options).cut.rays == 0);
        CHECK(render_cut<float>(scene, 0.01, options).cut.rays == 0);
    }
}

TEST_CASE("packets and the scalar reference cut the same rays", "[min_weight]")
{
    for (const NamedScene& named : bouncing_scenes())
        for (const double weight : {0.3, 0.03, 0.004}) {
            const CutPicture<double> expected =
                render_cut<double>(named.scene, weight, scalar_options());
            for (const std::string& isa : supported_isas()) {
                const RenderOptions options{.isa = isa};
                const CutPicture<double> picture = render_cut<double>(named.scene, weight, options);
                CAPTURE(named.name, weight, isa);
                CHECK(picture.cut.rays == expected.cut.rays);
                CHECK(picture.cut.bound == Approx(expected.cut.bound).epsilon(1e-9));
                CHECK(compare(picture.image, expected.image).max_abs <= 1e-9);
            }
        }
}

TEST_CASE("a weight that equals min_weight in decimals is traced in every precision",
          "[min_weight]")
{
    const auto decimals = [](int number, int digits) {
        std::string text = std::to_string(number);
        return "0." + std::string(static_cast<std::size_t>(digits) - text.size(), '0') + text;
    };
    constexpr int pixels = 5 * 5;
    for (int percent = 5; percent <= 95; percent += 5) {
        const Scene scene = parse(
            "image_size = 5 x 5\nillumination = general\nmax_depth = 4\n"
            "light { type = ambient intensity = 1 }\n"
            "plane { point = (0, 0, 5) normal = (0, 0, -1) ambient = 0.5 reflect = " +
            decimals(percent, 2) +
            " }\n"
            "plane { point = (0, 0, -5) normal = (0, 0, 1) ambient = 0.5 reflect = " +
            decimals(percent, 2) + " }\n");
        int power = 1;
        for (int bounces = 1; bounces <= 3; ++bounces) {
            power *= percent;
            const double weight = std::stod(decimals(power, 2 * bounces));
            const CutRays expected = render_cut<long double>(scene, weight, scalar_options()).cut;
            CAPTURE(percent, bounces, weight);
            CHECK(expected.rays == pixels);
            const auto check_same = [&](const CutRays& cut) {
                CHECK(cut.rays == expected.rays);
                CHECK(cut.bound == Approx(expected.bound).epsilon(1e-5));
            };
            check_same(render_cut<float>(scene, weight).cut);
            check_same(render_cut<double>(scene, weight).cut);
            check_same(render_cut<float>(scene, weight, scalar_options()).cut);
            check_same(render_cut<double>(scene, weight, scalar_options()).cut);
            // A ray whose weight is a thousandth less is not traced.
            CHECK(render_cut<double>(scene, weight * 1.001).cut.bound > 1.01 * expected.bound);
        }
    }
}

TEST_CASE("cut rays do not depend on width, threads, traversal or kernel", "[min_weight]")
{
    std::vector<std::string> isas = fused_isas();
    if (isas.empty())
        isas = supported_isas();
    for (const NamedScene& named : bouncing_scenes()) {
        RenderOptions options{.isa = isas.front()};
        const CutPicture<float> first = render_cut<float>(named.scene, 0.02, options);
        const auto check_same = [&](const RenderOptions& other) {
            const CutPicture<float> picture = render_cut<float>(named.scene, 0.02, other);
            CHECK((picture.image.rgb == first.image.rgb));
            CHECK(picture.cut.rays == first.cut.rays);
            CHECK(picture.cut.bound == first.cut.bound);
        };
        for (const std::string& isa : isas) {
            CAPTURE(named.name, isa);
            options = {};
            options.isa = isa;
            check_same(options);
            options.threads = 2;
            options.traversal = Traversal::tree;
            check_same(options);
            options.traversal = Traversal::list;
            options.force_general = true;
            check_same(options);
        }
    }
}

TEST_CASE("a min_weight of 0 cuts nothing, one of 1 all but rays of full weight", "[min_weight]")
{
    const Scene scene = small_scene(PACKTRACE_SOURCE_DIR "/scenes/nested_glass.scene");
    const CutPicture<float> whole = render_cut<float>(scene, 0.0);
    CHECK(whole.cut.rays == 0);
    CHECK(whole.cut.bound == 0.0);
    CHECK((whole.image.rgb == render<float>(scene).rgb));
    // Rays in glass have weights of at most 0.97.
    const CutPicture<float> none = render_cut<float>(scene, 1.0);
    Scene matt = scene;
    matt.max_depth = 0;
    CHECK((none.image.rgb == render<float>(matt).rgb));
}

TEST_CASE("cutting at 0.002 leaves little of the rays in nested glass", "[min_weight]")
{
    Scene scene = read_scene(PACKTRACE_SOURCE_DIR "/scenes/nested_glass.scene");
    set_size(scene, 64, 48);
    Image<float> image;
    const FrameCounts all = Renderer<float>(scene).render(image);
    scene.min_weight = 0.002;
    const FrameCounts heavy = Renderer<float>(scene).render(image);
    CHECK(all.cut.rays == 0);
    CHECK(heavy.cut.rays > 0);
    CHECK(5 * heavy.total() < all.total());
    CHECK(heavy.cut.bound < 0.5);
}

TEST_CASE("the brightest light that a scene may have leaves a finite bound", "[min_weight]")
{
    std::string text =
        "image_size = 9 x 9\nillumination = general\nmax_depth = 1\nshadows = transparent\n"
        "light { type = point position = (0, 9, 3) intensity = 1 }\n"
        "plane { point = (0, -1, 0) normal = (0, 1, 0) diffuse = 1 reflect = 0.01 }\n";
    const auto glass = [](int number) {
        return "sphere { center = (0, 3, " + std::to_string(number + 3) +
               ") radius = 0.1 transmit = 1e8 }\n";
    };
    for (int i = 0; i < 3; ++i)
        text += glass(i);
    const double bound = render_cut<float>(parse(text), 0.02).cut.bound;
    CHECK(bound > 1e20);
    CHECK(std::isfinite(bound));
    for (int i = 3; i < 40; ++i)
        text += glass(i);
    CHECK_THAT(error_of(text), ContainsSubstring("let colours grow"));
}

TEST_CASE("invalid weights are refused by every kernel", "[min_weight]")
{
    Scene scene = four_spheres(8, 8);
    for (const double weight : {-0.1, 1.5, std::nan("")}) {
        scene.min_weight = weight;
        CHECK_THROWS_AS((void)render<float>(scene), SceneError);
        CHECK_THROWS_AS((void)render<float>(scene, scalar_options()), SceneError);
    }
    CHECK(parse_with_sphere("min_weight = 0.004").min_weight == 0.004);
    CHECK(parse_with_sphere("").min_weight == 0.0);
    CHECK(error_of_line("min_weight = 1.5") ==
          "x.scene:2:14: 'min_weight' is 1.5; use a number from 0 to 1");
}

TEST_CASE("render reports how many rays it cut, and the bound of the error", "[min_weight]")
{
    const TempFolder folder;
    const std::string scene = PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene";
    const auto run = [&](const std::vector<std::string>& more, const std::string& name) {
        std::vector<std::string> words{"render", scene, "--size",
                                       "40x30",  "-o",  (folder / name).string()};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramResult result = run_packtrace(words);
        CHECK(result.exit_code == 0);
        return result.err;
    };
    CHECK_THAT(run({}, "whole.pfm"), !ContainsSubstring("not traced"));
    const std::string text = run({"--min-weight", "0.1"}, "cut.pfm");
    CHECK_THAT(text, ContainsSubstring("rays of a weight below 0.1 not traced"));
    CHECK(run({"--min-weight", "0.1", "-q"}, "quiet.pfm").empty());
    CHECK(read_text(folder / "quiet.pfm") == read_text(folder / "cut.pfm"));

    // The printed bound can be passed to compare.
    const std::string before = "no pixel is off by more than ";
    REQUIRE(text.find(before) != std::string::npos);
    std::string bound = text.substr(text.find(before) + before.size());
    bound = bound.substr(0, bound.find_first_of(" \n"));
    const std::vector<std::string> compared{"compare", (folder / "cut.pfm").string(),
                                            (folder / "whole.pfm").string()};
    auto within = compared;
    within.insert(within.end(), {"--max-error", bound});
    CHECK(run_packtrace(within).exit_code == 0);
    auto equal = compared;
    equal.insert(equal.end(), {"--max-error", "0"});
    CHECK(run_packtrace(equal).exit_code == 1);
    CHECK_THAT(run({"--min-weight", "0.1", "--adaptive", "0.1"}, "a.pfm"),
               ContainsSubstring("where the same samples are taken"));
}

TEST_CASE("info reports which weights are traced", "[min_weight]")
{
    const TempFolder folder;
    write_text(folder / "s.scene", std::string("min_weight = 0.004\n") + any_sphere);
    CHECK_THAT(run_packtrace({"info", (folder / "s.scene").string()}).out,
               ContainsSubstring("weights  from 0.004 on"));
    CHECK_THAT(run_packtrace({"info", (folder / "s.scene").string(), "--json"}).out,
               ContainsSubstring("\"min_weight\": 0.004"));
}

}  // namespace packtrace::test
