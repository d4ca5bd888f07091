// Exact coincidences: hits in the plane of projection, rays along surfaces and rays that start on
// surfaces.
#include "catch.hpp"
#include "lab/soak/soak.hpp"
#include "packet_ways.hpp"
#include "scenes.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include <tbb/global_control.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace packtrace::test {
namespace {

constexpr Accuracy both[] = {Accuracy::exact, Accuracy::fast};

/// The illumination models, each with a material that has next to no highlight.
constexpr std::pair<const char*, const char*> matt_in_each_model[] = {
    {"scratch", ""},
    {"sketch", "diffuse = 0.6"},
    {"whitted", "diffuse = 0.6"},
    {"shader", "reflectance = (0.1, 0.6, 0.3, 20)"},
    {"general", "diffuse = 0.6"}};

}  // namespace

TEST_CASE("An object in the plane of projection is visible", "[coincidences]")
{
    // Note 001's rays start at t = 1, and the wall is at t = 1 in the whole picture.
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
    for (const Accuracy accuracy : both)
        for (const RenderOptions& options : packet_ways(accuracy)) {
            INFO(options.isa);
            CHECK(largest_difference(render<double>(scene, options), truth) == 0.0);
            CHECK(largest_difference(render<float>(scene, options), truth) == 0.0);
        }
}

TEST_CASE("A ray that only touches the sphere it starts on does not hit it in any query",
          "[coincidences]")
{
    const Scene scene = parse_scene("sphere { center = (0, 2, 1)  radius = 1 }", "ball", {});
    const Ray<double> ray{{-0.0, 2, 0}, {0.12511034345577374, -0.25022068691154747, 0}};
    for (const Accuracy accuracy : both)
        for (const RenderOptions& options : packet_ways(accuracy)) {
            INFO(options.isa);
            const RayScene<double> rays(scene, options);
            CHECK(rays.closest_hit(ray).object == -1);
            CHECK_FALSE(rays.occluded(ray));
            CHECK(rays.all_hits(ray).empty());
        }
}

TEST_CASE("The near side of a very thin object is hit even if both roots round to one number",
          "[coincidences]")
{
    // Adjacent numbers in single precision are 1.2e-4 apart at 1000 and more.
    const Scene scene = parse_scene(R"(
        ellipsoid { scale = (1, 1, 1e-4)  translate = (0, 0, 1500) }
        quadric { coefficients = (0, 0, 1, 0, 0, 0, 0, 0, 0, -1)  scale = (1, 1, 5e-5)
                  rotate = (1, 0, 0, 30)  translate = (0, -40, 1600) }
    )",
                                    "thin", {});
    SceneRandom random(5);
    std::vector<Ray<float>> rays;
    for (int i = 0; i < 20000; ++i) {
        const auto number = [&](double low, double high) {
            return static_cast<float>(random.between(low, high));
        };
        rays.push_back({{number(-1, 1), number(-1, 1), number(0, 100)}, {0, 0, 1}});
    }
    for (const RenderOptions& options : packet_ways()) {
        INFO(options.isa);
        const RayScene<float> traced(scene, options);
        std::vector<SurfaceHit<float>> hits(rays.size());
        traced.closest_hits(RayStructs<float>(rays), HitStructs<float>(hits));
        int inside = 0;
        for (const SurfaceHit<float>& hit : hits)
            inside += hit.object == -1 || !(hit.normal[2] < 0.0f) ? 1 : 0;
        CHECK(inside == 0);
    }
}

namespace {

/// A thin lens cut from a ball of radius 10^6 by the plane z = base, where it is 1 wide.
Scene lens_of_a_large_ball(const std::string& base)
{
    return parse_scene(
        "quadric { coefficients = (1, 1, 1, 0, 0, 0, 0, 0, -2e6, -1)  "
        "z_range = (0, 1)  capped = yes  translate = (0, 0, " +
            base + ") }",
        "lens", {});
}

/// Rays that run nearly in the plane z = base and hit it within the lens: the largest error of t in
/// units of `Real`'s last place; infinite if a ray misses.
template <class Real>
double cap_error(const RayScene<Real>& traced, double base)
{
    SceneRandom random(11);
    double worst = 0.0;
    for (int i = 0; i < 500; ++i) {
        const double climb = std::pow(10.0, random.between(-6, -3));
        Ray<Real> ray;
        ray.org[0] = static_cast<Real>(random.between(-2.4, -1.6));
        ray.org[1] = static_cast<Real>(random.between(-0.5, 0.5));
        ray.org[2] = static_cast<Real>(base - 2 * climb);
        ray.dir[0] = 1;
        ray.dir[1] = static_cast<Real>(random.between(-0.01, 0.01));
        ray.dir[2] = static_cast<Real>(climb);
        // The difference of numbers this close to each other is exact.
        const double t = (base - static_cast<double>(ray.org[2])) / static_cast<double>(ray.dir[2]);
        const Vec3 met = Vec3(ray.org[0], ray.org[1], 0) + t * Vec3(ray.dir[0], ray.dir[1], 0);
        if (t <= 0 || met.x * met.x + met.y * met.y > 0.9)
            continue;
        const SurfaceHit<Real> hit = traced.closest_hit(ray);
        if (hit.object != 0)
            return std::numeric_limits<double>::infinity();
        const double digit = t * static_cast<double>(std::numeric_limits<Real>::epsilon());
        worst = std::max(worst, std::abs(static_cast<double>(hit.t) - t) / digit);
    }
    return worst;
}

}  // namespace

TEST_CASE("A cap is hit at its own plane, however far away the quadric's centre is",
          "[coincidences]")
{
    for (const char* base : {"0", "1000.1", "-77.3"}) {
        const Scene scene = lens_of_a_large_ball(base);
        CAPTURE(base);
        for (const RenderOptions& options : packet_ways()) {
            INFO(options.isa);
            CHECK(cap_error(RayScene<float>(scene, options), std::stod(base)) <= 1.0);
            CHECK(cap_error(RayScene<double>(scene, options), std::stod(base)) <= 8.0);
        }
    }
}

TEST_CASE("A ray along an asymptote of a turned quadric hits it once, wherever its axes lie",
          "[coincidences]")
{
    // xy + xz = z is linear along rays of constant x. Its axes are not parallel to the world's
    // axes.
    const Scene scene =
        parse_scene("quadric { coefficients = (0, 0, 0, 1, 1, 0, 0, 0, -1, 0) }", "turned", {});
    SceneRandom random(21);
    for (const RenderOptions& options : packet_ways()) {
        INFO(options.isa);
        const RayScene<double> wide(scene, options);
        const RayScene<float> single(scene, options);
        int wrong = 0;
        for (int i = 0; i < 300; ++i) {
            // Multiples of a quarter, so that all products are exact. The rays stay in a plane of
            // constant x.
            const auto quarters = [&] { return std::floor(random.between(-8, 9)) / 4; };
            const double x = quarters();
            const double y = quarters();
            const double z = quarters();
            const double dy = quarters();
            const double dz = quarters();
            const double value = x * y + x * z - z;
            const double slope = x * dy + x * dz - dz;
            if ((dy == 0 && dz == 0) || slope == 0 || value == 0)
                continue;
            const bool hits = -value / slope > 0;
            const Ray<double> ray{{x, y, z}, {0, dy, dz}};
            Ray<float> narrow;
            for (int axis = 0; axis < 3; ++axis) {
                narrow.org[axis] = static_cast<float>(ray.org[axis]);
                narrow.dir[axis] = static_cast<float>(ray.dir[axis]);
            }
            wrong += wide.occluded(ray) != hits || single.occluded(narrow) != hits ? 1 : 0;
            wrong += wide.all_hits(ray).size() != (hits ? 1u : 0u) ? 1 : 0;
            wrong += (single.closest_hit(narrow).object == 0) != hits ? 1 : 0;
        }
        CHECK(wrong == 0);
    }
}

namespace {

/// A carpet in exactly the plane of the floor, seen from 1000 away.
Scene carpet_on_floor(const std::string& illumination, const std::string& material)
{
    return parse_scene("illumination = " + illumination + R"(
        image_size = 48 x 48
        camera { position = (0, 1000, -1000)  look_at = (0, 0, 0)  fov = 0.2 }
        light { type = point  intensity = 1  position = (3, 40, -5) }
        plane { point = (0, 0, 0)  normal = (0, 1, 0)  )" +
                           material + R"( }
        polygon { vertices = (-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)  )" +
                           material + " }",
                       "carpet", {});
}

}  // namespace

TEST_CASE("Coincident surfaces do not shadow each other, from any distance", "[coincidences]")
{
    for (const auto& [illumination, material] : matt_in_each_model) {
        const Scene scene = carpet_on_floor(illumination, material);
        Scene unshadowed = scene;
        unshadowed.shadows = ShadowKind::none;
        CAPTURE(illumination);
        const auto darkened = [&](const RenderOptions& options) {
            return largest_difference(render<double>(scene, options),
                                      render<double>(unshadowed, options));
        };
        CHECK(darkened({.kernel = Kernel::scalar}) == 0.0);
        for (const RenderOptions& options : packet_ways()) {
            INFO(options.isa);
            CHECK(darkened(options) == 0.0);
        }
    }
}

namespace {

/// A ball on a floor, lit by a lamp at (0, `height`, 3). The lamp is below, on or inside `surface`,
/// whose lowest (or, seen from inside, highest) point is at height 2 there.
Scene lit_from(const std::string& height, const std::string& surface,
               const std::string& illumination, const std::string& material)
{
    return parse_scene("illumination = " + illumination + R"(
        image_size = 48 x 48
        camera { position = (0, 0, 0.75)  look_at = (0, 0, 3)  fov = 60 }
        light { type = point  intensity = 0.8  position = (0, )" +
                           height + R"(, 3) }
        sphere { center = (0, -0.5, 3)  radius = 0.5  )" +
                           material + R"( }
        plane { point = (0, -1, 0)  normal = (0, 1, 0)  )" +
                           material + " }\n" + surface + material + " }",
                       "lamp", {});
}

}  // namespace

TEST_CASE("A lamp on a surface lights the same points as a lamp slightly in front of it",
          "[coincidences]")
{
    const std::string surfaces[] = {
        "plane { point = (0, 2, 0)  normal = (0, 1, 0)  ",
        "plane { point = (0, 2, 0)  normal = (0, -1, 0)  ",
        "sphere { center = (0, -1, 3)  radius = 3  ",
        "sphere { center = (0, 2.5, 3)  radius = 0.5  ",
        "ellipsoid { scale = (1, 0.5, 1)  translate = (0, 2.5, 3)  ",
        "paraboloid { rotate = (1, 0, 0, -90)  translate = (0, 2, 3)  ",
        "cylinder { z_range = (0, 1)  capped = yes  rotate = (1, 0, 0, -90)  translate = (0, 2, 3) "
        " ",
        "polygon { vertices = (-2, 2, 1), (2, 2, 1), (2, 2, 5), (-2, 2, 5)  "};
    const RenderOptions scalar{.kernel = Kernel::scalar};
    for (const std::string& surface : surfaces)
        for (const auto& [illumination, material] : matt_in_each_model) {
            std::vector<Image<float>> truths;
            for (const char* const height : {"2", "1.9995", "2.0005"}) {
                const Scene scene = lit_from(height, surface, illumination, material);
                CAPTURE(surface, illumination, height);
                truths.push_back(convert<float>(render<long double>(scene, scalar)));
                const auto off = [&](const Image<float>& image) {
                    return compare(image, truths.back(), {.threshold = 0.02}).pixels_off;
                };
                CHECK(off(convert<float>(render<double>(scene, scalar))) <= 2);
                CHECK(off(render<float>(scene, scalar)) <= 2);
                for (const RenderOptions& options : packet_ways()) {
                    CAPTURE(options.isa, options.traversal);
                    CHECK(off(convert<float>(render<double>(scene, options))) <= 2);
                    CHECK(off(render<float>(scene, options)) <= 2);
                }
            }
            CAPTURE(surface, illumination);
            CHECK(compare(truths[0], truths[1], {.threshold = 0.02}).pixels_off <= 40);
        }
}

namespace {

/// Glass that stands on a floor at height `floor` or on other glass.
Scene standing_glass(const std::string& floor, const std::string& bodies)
{
    return parse_scene(R"(
        illumination = whitted
        image_size = 80 x 80
        background = rgb(0.2, 0.3, 0.6)
        camera { position = (0, 2, 0)  look_at = (0, -0.5, 5)  fov = 40 }
        light { type = ambient  intensity = 1 }
        plane { point = (0, 0, 0)  normal = (0, 1, 0)  translate = (0, )" +
                           floor + R"(, 0)  ambient = 1 }
    )" + bodies,
                       "glass", {});
}

/// A capped quadric that stands upright on the floor.
std::string glass_on(const std::string& floor, const std::string& what, const std::string& ior)
{
    return what + "  capped = yes  rotate = (1, 0, 0, -90)  translate = (0.1, " + floor +
           ", 5)  transmissive = 0.9  ior = " + ior + " }\n";
}

}  // namespace

TEST_CASE("Where a glass body stands on another, the first one in the scene is hit",
          "[coincidences]")
{
    for (const std::string floor : {"-1", "-0.7"}) {
        const std::string cylinder = "cylinder { z_range = (0, 0.6)";
        const std::string stacked = "cylinder { z_range = (0.6, 1.3)";
        const std::string scenes[] = {
            glass_on(floor, cylinder, "1.5"),
            glass_on(floor, cylinder, "1.5") + glass_on(floor, stacked, "1.3"),
            glass_on(floor, stacked, "1.3") + glass_on(floor, cylinder, "1.5"),
            glass_on(floor, "cone { z_range = (-1, 0)  scale = (1, 1, -1)", "1.5"),
            glass_on(floor, "ellipsoid { z_range = (0, 1)", "1.5")};
        for (const std::string& bodies : scenes) {
            const Scene scene = standing_glass(floor, bodies);
            const Image<float> truth =
                convert<float>(render<long double>(scene, {.kernel = Kernel::scalar}));
            for (const RenderOptions& options : packet_ways()) {
                CAPTURE(bodies, options.isa, options.traversal);
                const Image<float> image = render<float>(scene, options);
                CHECK(compare(image, truth, {.threshold = 1e-3}).pixels_off <= 2);
            }
        }
    }
}

namespace {

/// A cylinder of glass on one of water, whose common place has the coordinate `at` on all axes.
Scene glass_on_water(int at)
{
    std::string text = R"(
        illumination = general
        image_size = 32 x 24
        max_depth = 5
        camera { position = (AT, UP, BACK)  look_at = (AT, AT, AT)  fov = 40 }
        light { type = ambient  intensity = 1 }
        cylinder { z_range = (0, 1)  capped = yes  rotate = (1, 0, 0, -90)  translate = (AT, AT, AT)
                   ambient = (0.1, 0, 0)  transmit = 0.8  ior = 1.5 }
        cylinder { z_range = (-1, 0)  capped = yes  rotate = (1, 0, 0, -90)  translate = (AT, AT, AT)
                   ambient = (0, 0.3, 0)  reflect = 0.3  transmit = 0.8  ior = 1.33 }
    )";
    const std::pair<std::string, int> words[] = {{"AT", at}, {"UP", at + 2}, {"BACK", at - 4}};
    for (const auto& [word, number] : words)
        for (auto place = text.find(word); place != text.npos; place = text.find(word))
            text.replace(place, word.size(), std::to_string(number));
    return parse_scene(text, "glass on water", {});
}

}  // namespace

TEST_CASE("Where a glass body stands on another far away, the first one in the scene is hit too",
          "[coincidences]")
{
    // The further from the world's origin, the further a ray's origin is moved off its surface.
    for (const int at : {0, 64, 1024}) {
        const Scene scene = glass_on_water(at);
        const Image<double> truth = render<double>(scene, {.kernel = Kernel::scalar});
        for (const RenderOptions& options : packet_ways(Accuracy::exact)) {
            CAPTURE(at, options.isa);
            CHECK(largest_difference(render<double>(scene, options), truth) < 1e-9);
            CHECK(largest_difference(render<float>(scene, options), truth) < 1e-5);
        }
    }
}

TEST_CASE("A quadric is seen in its own place, even if single precision cannot hold that place",
          "[coincidences]")
{
    // Adjacent numbers in single precision are 0.06 apart there.
    const Scene scene = parse_scene(R"(
        illumination = whitted
        image_size = 64 x 64
        camera { position = (1000000, 0, 0)  look_at = (1000000.03, 0, 0.2)  fov = 20 }
        light { type = ambient  intensity = 1 }
        ellipsoid { scale = (0.02, 0.02, 0.018)  translate = (1000000.03, 0, 0.2)  ambient = 1 }
    )",
                                    "far", {});
    const Image<float> truth = convert<float>(render<double>(scene, {.kernel = Kernel::scalar}));
    for (RenderOptions options : packet_ways())
        for (const bool force_general : {false, true}) {
            options.force_general = force_general;
            CAPTURE(options.isa, options.traversal, force_general);
            CHECK(compare(render<float>(scene, options), truth, {.threshold = 1e-3}).pixels_off ==
                  0);
        }
}

TEST_CASE("Rays with the shortest directions are not occluded by objects that they pass",
          "[coincidences]")
{
    // The line passes the sphere at 1.0074 times its radius; squares in single precision underflow.
    const Scene scene = parse_scene(
        "sphere { center = (5.8765989623179028e-11, -3.0423624523883822e-10, "
        "9.0241271561315684e-11)  radius = 1e-10 }",
        "small", {});
    const Ray<float> ray{{-3.11396547e-10f, -6.42711606e-10f, -2.18380133e-10f},
                         {1.35559316e-12f, 8.55627309e-13f, 1.19593853e-12f}};
    for (const RenderOptions& options : packet_ways()) {
        INFO(options.isa);
        const RayScene<float> traced(scene, options);
        CHECK_FALSE(traced.occluded(ray));
        CHECK(traced.closest_hit(ray).object == -1);
    }
}

TEST_CASE("Rays along planes never hit them, however the planes are turned", "[coincidences]")
{
    struct Turned {
        const char* normal;
        Vec3 along;  ///< perpendicular to the normal, as is `other`
        Vec3 other;
    };
    const Turned turned[] = {{"(1, 1, 0)", {1, -1, 0}, {0, 0, 1}},
                             {"(0, 1, -1)", {0, 1, 1}, {1, 0, 0}},
                             {"(1, 1, 1)", {1, -1, 0}, {0, 1, -1}},
                             {"(-1, 1, -1)", {1, 1, 0}, {0, 1, 1}}};
    SceneRandom random(3);
    for (const auto& [normal, along, other] : turned) {
        CAPTURE(normal);
        const Scene scene = parse_scene(
            std::string("plane { point = (3, -2, 7)  normal = ") + normal + " }", "turned", {});
        // Only `exact` decides this.
        for (const RenderOptions& options : packet_ways()) {
            const RayScene<float> single(scene, options);
            const RayScene<double> wide(scene, options);
            // Without fused products doubles have no spare digits.
            const bool fused = options.isa != "sse42";
            int hits = 0;
            for (int i = 0; i < 200; ++i) {
                // Whole numbers, so that all products and sums are exact.
                const double a = std::round(random.between(-999, 999));
                const double b = std::round(random.between(-999, 999));
                const Vec3 dir = a * along + b * other;
                const double off = i % 2 == 0 ? 0.0 : std::round(random.between(1, 99));
                const Vec3 org = Vec3(3, -2, 7) + std::round(random.between(-99, 99)) * along -
                                 std::round(random.between(-99, 99)) * other + Vec3(off, 0, 0);
                if (dir == Vec3(0.0))
                    continue;
                Ray<float> narrow;
                Ray<double> ray;
                for (int axis = 0; axis < 3; ++axis) {
                    ray.org[axis] = org[axis];
                    ray.dir[axis] = dir[axis];
                    narrow.org[axis] = static_cast<float>(org[axis]);
                    narrow.dir[axis] = static_cast<float>(dir[axis]);
                }
                hits += single.closest_hit(narrow).object == 0 ? 1 : 0;
                hits += wide.closest_hit(ray).object == 0 ? 1 : 0;
                hits += single.occluded(narrow) ? 1 : 0;
                hits += static_cast<int>(wide.all_hits(ray).size());
            }
            INFO(options.isa);
            if (fused)
                CHECK(hits == 0);
        }
    }
}

TEST_CASE("Scenes with many coincidences give the same bits in every way of tracing",
          "[coincidences]")
{
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 3);
    const lab::SoakOptions options{.scenes = 96, .aligned = true};
    std::string findings;
    const lab::SoakCounts counts = lab::run_soak(options, [&](const lab::SoakReport& report) {
        findings += std::to_string(report.number) + ": " + report.finding.what + "\n";
    });
    CHECK(findings == "");
    CHECK(counts.scenes == 96);
    CHECK(counts.refused < 48);
}

}  // namespace packtrace::test
