// Mirrors and glass in packets against the laws of optics and the promises about memory.
#include "catch.hpp"
#include "dispatch/kernels.hpp"
#include "lower/packed_scene.hpp"
#include "peak_memory.hpp"
#include "reference_scenes.hpp"
#include "render_scene.hpp"
#include <packtrace/renderer.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>

namespace packtrace::test {
namespace {

const double pi = std::acos(-1.0);

Material clear(double ior)
{
    return shaded(WhittedMaterial{Rgb(0), Rgb(0), Rgb(0), Rgb(1), 1.0, ior});
}

/// A material that neither emits nor mirrors.
Material black()
{
    return shaded(WhittedMaterial{});
}

Material white()
{
    return shaded(WhittedMaterial{Rgb(1), Rgb(0), Rgb(0), Rgb(0), 1.0, 1.0});
}

/// Note 000's transparent object: Kd = 0 and Ks + Kr = 1, with different shares in each channel.
Material conserving(double ior)
{
    return shaded(SketchMaterial{Rgb(0), Rgb(0), {0.25, 0.5, 0.75}, {0.75, 0.5, 0.25}, 50.0, ior});
}

/// One pixel, whose ray runs along `dir` from `org`, in the x-z plane.
Scene one_ray(const Vec3& org, const Vec3& dir)
{
    Scene scene;
    scene.width = scene.height = 1;
    scene.illumination = Illumination::whitted;
    scene.max_depth = 6;
    scene.camera.position = org;
    scene.camera.rotation = look_at(org, org + dir, {0, 1, 0});
    scene.camera.pixel_sample = {0.5, 0.5};
    scene.lights = {ambient(1.0)};
    return scene;
}

template <class Real>
double seen(const Scene& scene, const std::string& isa)
{
    return static_cast<double>(render_packets<Real>(scene, isa).rgb[0]);
}

/// Glass between z = -1 and z = 1, as a pair of planes.
Object slab(double ior)
{
    return quadric({0, 0, 1, 0, 0, 0, 0, 0, 0, -1}, clear(ior));
}

/// The same slab between the caps of a wide cylinder.
Object disc(double ior)
{
    Object object = quadric({1, 1, 0, 0, 0, 0, 0, 0, 0, -400}, clear(ior));
    std::get<Quadric>(object.surface).z_range = ZRange{-1, 1};
    std::get<Quadric>(object.surface).capped = true;
    return object;
}

/// Behind z = 6: white for x below `edge`, black above.
Object edge_at(double edge)
{
    Object screen = plane({edge, 0, 6}, {0, 0, -1}, white());
    // Its u axis is x. The squares are far larger than the scene, and y = 0 is inside one.
    std::get<Plane>(screen.surface).point.y = -500;
    screen.material.color = Rgb(0);
    screen.material.checker = Checker{Rgb(1), 1000.0};
    return screen;
}

/// Balls inside balls with the eye in the innermost; every hit has two children.
Scene shells(int depth)
{
    Scene scene;
    scene.width = scene.height = 2;
    scene.illumination = Illumination::sketch;
    scene.background = {0.5, 0.25, 1.0};
    scene.max_depth = depth;
    for (int i = 0; i < 8; ++i)
        scene.objects.push_back(
            sphere({0.01 * i, 0.02 * i, 0}, 1.0 + i, conserving(i % 2 == 0 ? 1.2 : 1.25)));
    return scene;
}

template <class Real>
std::size_t scratch_bytes(const Scene& scene, const std::string& isa)
{
    const LoweredScene lowered = lower(scene, accuracy_in<Real>({}));
    const PackedScene<Real> packed(lowered);
    return kernels_for(precision<Real>(kernels_of(isa)), lowered.features)
        .scratch_bytes(packed.view(), 1);
}

}  // namespace

TEMPLATE_TEST_CASE("if Ks + Kr = 1 a uniform background is all that is seen", "[glass_physics]",
                   float, double)
{
    Scene scene{.width = 61,
                .height = 47,
                .background = {0.75, 0.5, 0.25},
                .illumination = Illumination::sketch,
                .max_depth = 8,
                .objects = {sphere({0, 0, 4}, 1.5, conserving(1.5)),
                            sphere({0.2, 0.1, 4}, 1.2, conserving(1.0)),
                            sphere({-1.3, 0.3, 3.2}, 0.8, conserving(2.4)),
                            quadric({1, 1, -1, 0, 0, 0, 0, 0, 0, -0.2}, conserving(1.3)),
                            plane({0, -2, 0}, {0, 1, 0}, conserving(1.33))}};
    scene.objects[3].transform = glm::translate(Mat4(1.0), {1.5, 0.5, 6});
    const double margin = 64 * static_cast<double>(std::numeric_limits<TestType>::epsilon());
    for (const std::string& isa : supported_isas()) {
        const Image<TestType> picture = render_packets<TestType>(scene, isa);
        double worst = 0.0;
        for (std::size_t i = 0; i < picture.rgb.size(); ++i)
            worst = std::max(worst, std::abs(static_cast<double>(picture.rgb[i]) -
                                             scene.background[static_cast<int>(i % 3)]));
        CAPTURE(isa, worst);
        CHECK(worst < margin);
    }
}

TEMPLATE_TEST_CASE("total internal reflection begins within 1e-6 of the critical angle",
                   "[glass_physics]", float, double)
{
    for (const double ior : {1.33, 1.5, 2.4})
        for (const double offset : {-1e-6, 1e-6}) {
            const double angle = std::asin(1 / ior) + offset;
            // The ray starts in the glass below z = 0, whose floor is black; the sky is white.
            Scene scene = one_ray({0, 0, -1}, {std::sin(angle), 0, std::cos(angle)});
            scene.background = Rgb(1);
            scene.objects = {plane({0, 0, 0}, {0, 0, 1}, clear(ior)),
                             plane({0, 0, -3}, {0, 0, 1}, black())};
            for (const std::string& isa : supported_isas()) {
                CAPTURE(ior, offset, isa);
                CHECK(seen<TestType>(scene, isa) == (offset < 0 ? 1.0 : 0.0));
            }
        }
}

TEMPLATE_TEST_CASE("glass with an ior of 1 lets even a grazing ray go straight on",
                   "[glass_physics]", float, double)
{
    // Descends by 1 over 10000, into the black floor half a unit below the sheet.
    Scene scene = one_ray({0, 0, 0.1}, {1, 0, -1e-4});
    scene.background = Rgb(1);
    scene.objects = {plane({0, 0, 0}, {0, 0, 1}, clear(1.0)),
                     plane({0, 0, -0.5}, {0, 0, 1}, black())};
    for (const std::string& isa : supported_isas())
        CHECK(seen<TestType>(scene, isa) == 0.0);
    CHECK(render<TestType>(scene, {.kernel = Kernel::scalar}).rgb[0] == 0);
}

TEMPLATE_TEST_CASE("a slab shifts a ray by the analytic amount", "[glass_physics]", float, double)
{
    const double margin = std::is_same_v<TestType, float> ? 2e-5 : 1e-12;
    for (const bool capped : {false, true})
        for (const double degrees : {0.0, 10.0, 45.0, 70.0}) {
            const double angle = degrees * pi / 180;
            const double within = std::asin(std::sin(angle) / 1.5);
            // The ray crosses seven units of z in air and two in glass.
            const double expected = 7 * std::tan(angle) + 2 * std::tan(within);
            Scene scene = one_ray({0, 0, -3}, {std::sin(angle), 0, std::cos(angle)});
            for (const std::string& isa : supported_isas()) {
                CAPTURE(capped, degrees, isa);
                scene.objects = {capped ? disc(1.5) : slab(1.5), edge_at(expected + margin)};
                CHECK(seen<TestType>(scene, isa) == 1.0);
                scene.objects[1] = edge_at(expected - margin);
                CHECK(seen<TestType>(scene, isa) == 0.0);
            }
        }
}

TEMPLATE_TEST_CASE("scratch memory grows by one stream per level, whatever the tree",
                   "[glass_physics]", float, double)
{
    // A stream holds two children for each of 256 rays and a packet's padding. Each child has
    // origin, direction, weight, pixel, eight media, and its start: point, surface, other root and
    // the piece hit there. The stream's count follows.
    const std::size_t stream = 528 * (3 + 3 + 3 + 1 + 8 + 3 + 1 + 2) * sizeof(TestType) + 64;
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        const std::size_t flat = scratch_bytes<TestType>(shells(1), isa);
        for (const int depth : {2, 10, 20, 64})
            CHECK(scratch_bytes<TestType>(shells(depth), isa) ==
                  flat + static_cast<std::size_t>(depth - 1) * stream);
    }
}

TEMPLATE_TEST_CASE("depth 20 with two children per hit renders in little memory and loses no light",
                   "[glass_physics]", float, double)
{
    const Scene scene = shells(20);
    const Renderer<TestType> renderer(scene, {.threads = 1});
    Image<TestType> image(2, 2);
    FrameCounts counts;
    // Its streams take 1.6 MB; storing a ray for each leaf would take over 100 MB.
    const long growth = peak_growth([&] { counts = renderer.render(image); });
    REQUIRE(memory_status("VmHWM") > 0);
    CAPTURE(growth);
    CHECK(growth <= 4096 + sanitizer_kilobytes);
    // The trees of four pixels could have 4 * 2^20 leaves; these rays have not escaped.
    CHECK(counts.reflected > 1'000'000);
    CHECK(counts.refracted > 1'000'000);
    // In single precision a sum of a million small terms loses digits.
    const double margin = std::is_same_v<TestType, float> ? 1e-2 : 1e-9;
    for (int i = 0; i < 12; ++i)
        CHECK(std::abs(static_cast<double>(image.rgb[static_cast<std::size_t>(i)]) -
                       scene.background[i % 3]) < margin);
}

}  // namespace packtrace::test
