// Several samples per pixel, everywhere or only at high contrast.
#include "catch.hpp"
#include "image/contrast.hpp"
#include "image/pixel_error.hpp"
#include "packet_scenes.hpp"
#include "refusal.hpp"
#include "render_scene.hpp"
#include "run_program.hpp"
#include "scene/sample_pattern.hpp"
#include <packtrace/compare.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace packtrace::test {
namespace {

RenderOptions sampled(int samples, std::optional<double> adaptive = {})
{
    return {.samples = samples, .adaptive = adaptive};
}

template <class Real>
Image<Real> centre_picture(Scene scene, RenderOptions options)
{
    scene.camera.pixel_sample = Vec2(0.5);
    options.samples = 1;
    options.adaptive.reset();
    return render<Real>(scene, options);
}

/// Compares a pixel with every neighbour, one by one.
template <class Real>
bool differs_from_a_neighbour(const Image<Real>& image, int x, int y, double threshold)
{
    for (int j = y - 1; j <= y + 1; ++j)
        for (int i = x - 1; i <= x + 1; ++i)
            if (i >= 0 && j >= 0 && i < image.width &&
                j<image.height&& static_cast<double>(
                    pixel_error(image.pixel(x, y), image.pixel(i, j)))>
                    threshold)
                return true;
    return false;
}

template <class Real>
bool same_pixel(const Image<Real>& a, const Image<Real>& b, int x, int y)
{
    return std::equal(a.pixel(x, y), a.pixel(x, y) + 3, b.pixel(x, y));
}

/// The number of pixels that differ by more than `limit` in a channel.
int count_off(const Image<double>& a, const Image<double>& b, double limit)
{
    int count = 0;
    for (std::size_t pixel = 0; pixel < a.rgb.size(); pixel += 3) {
        double off = 0;
        for (std::size_t channel = pixel; channel < pixel + 3; ++channel)
            off = std::max(off, std::abs(a.rgb[channel] - b.rgb[channel]));
        count += off > limit ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST_CASE("samples are in the pixel, around its centre, on a grid", "[sampling]")
{
    for (int count = 1; count <= 1024; ++count) {
        const std::vector<Vec2> pattern = sample_pattern(count);
        REQUIRE(pattern.size() == static_cast<std::size_t>(count));
        Vec2 mean(0.0);
        for (const Vec2& place : pattern) {
            mean += place / static_cast<double>(count);
            for (const double x : {place.x, place.y}) {
                REQUIRE(x >= 0.0);
                REQUIRE(x < 1.0);
                REQUIRE(x * 4096.0 == std::floor(x * 4096.0));
            }
        }
        CAPTURE(count);
        CHECK(std::abs(mean.x - 0.5) <= 0.5 / 4096.0);
        CHECK(std::abs(mean.y - 0.5) <= 0.5 / 4096.0);
    }
    CHECK((sample_pattern(1).front() == Vec2(0.5)));
}

TEST_CASE("each row and column of a pixel has exactly one sample", "[sampling]")
{
    for (const int count : {1, 4, 7, 16, 100, 256}) {
        std::set<int> columns;
        std::set<int> rows;
        for (const Vec2& place : sample_pattern(count)) {
            columns.insert(static_cast<int>(place.x * count));
            rows.insert(static_cast<int>(place.y * count));
        }
        CAPTURE(count);
        CHECK(columns.size() == static_cast<std::size_t>(count));
        CHECK(rows.size() == static_cast<std::size_t>(count));
    }
}

TEMPLATE_TEST_CASE("contrast is the largest difference from a neighbour", "[sampling]", float,
                   double)
{
    for (const auto& [width, height] : {std::pair{37, 23}, {1, 9}, {8, 1}, {1, 1}}) {
        const Image<TestType> image = render_packets<TestType>(four_spheres(width, height), "auto");
        for (const double threshold : {0.0, 0.02, 0.3}) {
            ContrastMap<TestType> map(image, static_cast<TestType>(threshold));
            for (int y = 0; y < height; ++y) {
                map.mark_row(y);
                for (int x = 0; x < width; ++x) {
                    const auto rounded = static_cast<double>(static_cast<TestType>(threshold));
                    CAPTURE(width, height, threshold, x, y);
                    REQUIRE(map(x, y) == differs_from_a_neighbour(image, x, y, rounded));
                }
            }
        }
    }
}

TEST_CASE("packets take the reference's samples", "[sampling]")
{
    for (const NamedScene& named : packet_scenes())
        for (const RenderOptions& options : {sampled(6), sampled(16, 0.05)}) {
            RenderOptions scalar = options;
            scalar.kernel = Kernel::scalar;
            const auto expected = render<double>(named.scene, scalar);
            const auto packets = render<double>(named.scene, options);
            const Comparison error = compare(packets, expected);
            CAPTURE(named.name, options.samples, error.max_abs);
            // The room's seams pass through the middle of the picture, where only adaptive sampling
            // puts samples: its first sample is at a pixel's centre. The contrast there may round
            // to either side of the threshold, and then the kernels take different numbers of
            // samples.
            if (options.adaptive)
                CHECK(count_off(packets, expected, 1e-3) <= 2);
            else
                CHECK(error.max_abs <= 1e-9);
        }
}

TEMPLATE_TEST_CASE("sampled pictures are the same for every width and number of threads",
                   "[sampling][determinism]", float, double)
{
    const Scene scene = four_spheres(117, 85);
    for (RenderOptions options : {sampled(4), sampled(7), sampled(16, 0.02)}) {
        Image<TestType> first;
        for (const std::string& isa : fused_isas())
            for (const int threads : {1, 2}) {
                options.isa = isa;
                options.threads = threads;
                const Image<TestType> picture = render<TestType>(scene, options);
                if (first.rgb.empty())
                    first = picture;
                CAPTURE(isa, threads, options.samples);
                CHECK((picture.rgb == first.rgb));
            }
    }
}

TEMPLATE_TEST_CASE("adaptive pixels equal those of all samples, or those of the centre",
                   "[sampling]", float, double)
{
    const Scene scene = four_spheres(117, 85);
    for (const Kernel kernel : {Kernel::packet, Kernel::scalar}) {
        RenderOptions options = sampled(16);
        options.kernel = kernel;
        const auto all = render<TestType>(scene, options);
        const auto centre = centre_picture<TestType>(scene, options);
        const double threshold = 0.0625;
        options.adaptive = threshold;
        const auto adaptive = render<TestType>(scene, options);
        int refined = 0;
        for (int y = 0; y < scene.height; ++y)
            for (int x = 0; x < scene.width; ++x) {
                const bool full = differs_from_a_neighbour(centre, x, y, threshold);
                refined += full;
                CAPTURE(x, y, full);
                REQUIRE(same_pixel(adaptive, full ? all : centre, x, y));
            }
        CHECK(refined > 100);
        CHECK(refined < scene.width * scene.height / 2);
    }
}

TEST_CASE("more samples are closer to the mean of very many", "[sampling]")
{
    const Scene scene = four_spheres(160, 120);
    const auto truth = render<double>(scene, sampled(1024));
    const auto error = [&](const RenderOptions& options) {
        return compare(render<double>(scene, options), truth).rmse;
    };
    const double four = error(sampled(4));
    const double sixteen = error(sampled(16));
    CHECK(compare(centre_picture<double>(scene, {}), truth).rmse > 2.0 * four);
    CHECK(four > 1.5 * sixteen);
    CHECK(sixteen > 1.5 * error(sampled(64)));
}

TEST_CASE("adaptive sampling reaches the error of 16 samples with a third of the rays",
          "[sampling]")
{
    const Scene scene = four_spheres(512, 512);
    const auto truth = render<double>(scene, sampled(256));
    Image<float> uniform;
    Image<float> adaptive;
    const Renderer<float> sixteen(scene, sampled(16));
    const Renderer<float> few(scene, sampled(20, 0.01));
    const auto rays = sixteen.render(uniform).total();
    CHECK(3 * few.render(adaptive).total() <= rays);
    CHECK(compare(convert<double>(adaptive), truth).rmse <=
          compare(convert<double>(uniform), truth).rmse);
}

TEST_CASE("impossible sampling is refused", "[sampling]")
{
    const Scene scene = four_spheres(8, 8);
    for (const Kernel kernel : {Kernel::packet, Kernel::scalar}) {
        const auto message = [&](RenderOptions options) {
            options.kernel = kernel;
            return refusal<std::invalid_argument>([&] { return render<float>(scene, options); });
        };
        CHECK(message(sampled(0)) == "samples: 0; choose from 1 to 1024");
        CHECK(message(sampled(1025)) == "samples: 1025; choose from 1 to 1024");
        CHECK(message(sampled(4, -1.0)) == "adaptive: -1; choose a finite number >= 0");
        CHECK(message(sampled(4, std::nan(""))) == "adaptive: nan; choose a finite number >= 0");
        CHECK(message(sampled(1, 0.1)) == "adaptive: needs more than one sample a pixel");
    }
}

TEST_CASE("render takes a number of samples per pixel", "[sampling][sampling_cli]")
{
    const TempFolder folder;
    const auto rendered = [&](const std::vector<std::string>& options) {
        std::vector<std::string> words{
            "render", four_spheres_file,          "-q", "--size", "64x48",
            "-o",     (folder / "a.pfm").string()};
        words.insert(words.end(), options.begin(), options.end());
        CHECK(run_packtrace(words).exit_code == 0);
        return read_text(folder / "a.pfm");
    };
    const std::string one = rendered({});
    CHECK(rendered({"--spp", "1"}) == one);
    CHECK(rendered({"--spp", "16"}) != one);
    CHECK(rendered({"--adaptive", "0.1"}) == rendered({"--adaptive", "0.1", "--spp", "16"}));
    CHECK(rendered({"--adaptive", "0.1"}) != rendered({"--spp", "16"}));
}

TEST_CASE("render refuses invalid sampling options", "[sampling][sampling_cli]")
{
    const auto message = [](const std::vector<std::string>& options) {
        std::vector<std::string> words{"render", four_spheres_file, "-o", "/dev/null/a.png"};
        words.insert(words.end(), options.begin(), options.end());
        const ProgramResult result = run_packtrace(words);
        CHECK(result.exit_code == 2);
        return result.err;
    };
    CHECK_THAT(message({"--spp", "0"}), ContainsSubstring("--spp"));
    CHECK_THAT(message({"--spp", "1025"}), ContainsSubstring("from 1 to 1024"));
    CHECK_THAT(message({"--adaptive", "-1"}), ContainsSubstring("--adaptive"));
    CHECK_THAT(message({"--adaptive", "0.1", "--spp", "1"}),
               ContainsSubstring("needs more than one sample"));
}

}  // namespace packtrace::test
