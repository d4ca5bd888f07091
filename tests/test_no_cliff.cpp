// The hits of a caller's rays depend only on the objects near the rays. They do not depend on
// camera and lights, nor on other objects of the scene.
#include "catch.hpp"
#include "lab/stress/placed_quadric.hpp"
#include "lab/stress/stress_subject.hpp"
#include "packet_ways.hpp"
#include "render_scene.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include <cmath>
#include <optional>
#include <string>

namespace packtrace::test {
namespace {

constexpr std::size_t ray_count = 2000;

/// Spheres on a ground sphere, a plane, and quadrics of four kinds.
Scene mixed_scene()
{
    lab::StressRandom random(5);
    Scene scene{.objects = {lab::sphere_object({0, -1, 3}, 1), lab::sphere_object({-2, 1, 3}, 1),
                            lab::sphere_object({2, 1, 3}, 1),
                            lab::sphere_object({0, -5001, 0}, 5000),
                            lab::sphere_object({3, 2, 60}, 0.002),
                            lab::plane_object({0, 0, 90}, {0, 0.6, -0.8})}};
    for (const QuadricKind kind : {QuadricKind::ellipsoid, QuadricKind::cylinder, QuadricKind::cone,
                                   QuadricKind::paraboloid}) {
        scene.objects.push_back(
            {.surface = packtrace::quadric(kind),
             .transform = lab::any_placement(random, lab::any_stretch(random, 0.05),
                                             random.box(3.0) + Vec3(0, 2, 8))});
    }
    return scene;
}

/// Rays from around the origin, all of them forwards.
template <class Real>
RayColumns<Real> forward_rays()
{
    lab::StressRandom random(11);
    RayColumns<Real> rays;
    for (std::size_t i = 0; i < ray_count; ++i) {
        const Vec3 org = random.box(0.5);
        const double right = random.between(-1.0, 1.0);
        const double up = random.between(-0.6, 0.6);
        rays.add(org, {right, up, 1.0});
    }
    return rays;
}

/// All answers of closest hits, any hits and all hits, in order.
template <class Real>
std::vector<double> answers_of(const Scene& scene, const RenderOptions& options)
{
    const RayScene<Real> rays(scene, options);
    const RayColumns<Real> forward = forward_rays<Real>();
    LeftHitColumns<Real> found(ray_count);
    rays.closest_hits(forward.view(), found.view());
    std::vector<std::uint8_t> occluded(ray_count);
    rays.occluded(forward.view(), occluded.data());

    std::vector<double> answers;
    for (std::size_t i = 0; i < ray_count; ++i) {
        const bool hit = found.object[i] >= 0;
        answers.push_back(found.object[i]);
        answers.push_back(occluded[i]);
        answers.push_back(hit ? static_cast<double>(found.t[i]) : 0.0);
        for (const auto* columns :
             {&found.normal, &found.outer_start, &found.inner_start, &found.point})
            for (const auto& column : *columns)
                answers.push_back(hit ? static_cast<double>(column[i]) : 0.0);
    }
    rays.all_hits(forward.view(), [&](std::size_t, std::span<const SurfaceHit<Real>> hits) {
        for (const SurfaceHit<Real>& hit : hits) {
            answers.push_back(hit.object);
            answers.push_back(static_cast<double>(hit.t));
            for (const Real n : hit.normal)
                answers.push_back(static_cast<double>(n));
        }
    });
    return answers;
}

struct Change {
    std::string what;
    Scene scene;
};

/// Adds objects behind all rays and above them.
void add_objects_elsewhere(Scene& scene, int count)
{
    lab::StressRandom random(3);
    for (int i = 0; i < count; ++i)
        scene.objects.push_back(
            lab::sphere_object(random.box(100.0) + Vec3(0, 250, -250), random.power(0.01, 1.0)));
}

/// Changes of a scene that must not change its rays' hits.
std::vector<Change> changes()
{
    std::vector<Change> all;
    for (const double far : {1.0, 30.0, 1e3, 3e4, 1e6}) {
        all.push_back({"eye " + std::to_string(far) + " away", mixed_scene()});
        all.back().scene.camera.position = far * Vec3(0.6, 0.48, -0.64);
        all.push_back({"light " + std::to_string(far) + " away", mixed_scene()});
        all.back().scene.lights.push_back(
            {.type = LightType::point, .vector = far * Vec3(-0.48, 0.8, 0.36)});
    }
    for (const int count : {1, 100, 10000}) {
        all.push_back({std::to_string(count) + " objects elsewhere", mixed_scene()});
        add_objects_elsewhere(all.back().scene, count);
    }
    return all;
}

template <class Real>
void check_no_cliff(const RenderOptions& options)
{
    const std::vector<double> before = answers_of<Real>(mixed_scene(), options);
    for (const Change& change : changes()) {
        CAPTURE(change.what);
        CHECK((answers_of<Real>(change.scene, options) == before));
    }
}

/// A floor, what stands on it, and one light at this distance.
Scene lit_from(double distance, const std::string& more = "")
{
    Scene scene = parse_scene(more + R"(
        image_size = 96 x 72
        camera { position = (0, 2.5, -7)  look_at = (0, 0.6, 0) }
        plane { point = (0, 0, 0)  normal = (0, 1, 0) }
        sphere { center = (-1.5, 1, 0)  radius = 1 }
        sphere { center = (0.3, 0.3, -1.5)  radius = 0.3  reflective = 0.4 }
        cylinder { z_range = (-0.5, 0.5)  capped = true  rotate = (1, 0, 0, 90)
                   translate = (1.5, 0.5, 0) }
        polygon { vertices = (-1, 1.8, 1), (1, 1.8, 1), (0, 2.6, 1.4) }
        # A wire 2000 times as long as it is thick, and an elliptic post turned against its axes.
        cylinder { z_range = (0, 1)  capped = true  scale = (0.002, 0.002, 4)
                   rotate = (1, 0, 0, -90)  translate = (2, 0, 2) }
        quadric { coefficients = (1, 1, 0, 0.5, 0.2, 0, 0.6, 0, 0, -1)  z_range = (0, 1)
                  capped = true  scale = (0.3, 0.3, 2)  rotate = (1, 0, 0, -90)
                  translate = (-2.5, 0, 2) }
        light { type = ambient  intensity = 0.2 }
    )",
                              "lit", {});
    scene.lights.push_back({.type = LightType::point,
                            .intensity = Rgb(0.7),
                            .vector = distance * Vec3(-0.48, 0.8, -0.36)});
    return scene;
}

/// The number of pixels that are off by more than 2 / 255. In a picture this small, a shadow's edge
/// differs in few pixels.
int pixels_off(const Image<float>& image, const Image<double>& truth)
{
    int off = 0;
    for (std::size_t i = 0; i < truth.rgb.size(); i += 3) {
        bool differs = false;
        for (std::size_t c = i; c < i + 3; ++c)
            differs |= std::abs(static_cast<double>(image.rgb[c]) - truth.rgb[c]) > 2.0 / 255.0;
        off += differs ? 1 : 0;
    }
    return off;
}

/// Compares packets of floats, in every way, with the scalar reference in double.
void check_like_scalar(const Scene& scene, int most_off)
{
    const Image<double> truth = render_scalar<double>(scene);
    for (const RenderOptions& options : packet_ways()) {
        CAPTURE(options.isa, options.traversal);
        CHECK(pixels_off(render<float>(scene, options), truth) <= most_off);
    }
}

}  // namespace

TEST_CASE("shadows do not move with the distance of a light", "[no_cliff]")
{
    for (const double distance : {10.0, 1e4, 1e6, 1e7, 1e8, 5e8}) {
        const Scene scene = lit_from(distance);
        const Image<double> truth = render_scalar<double>(scene);
        std::optional<Image<float>> fused;
        for (RenderOptions options : packet_ways())
            for (const bool force_general : {false, true}) {
                CAPTURE(distance, options.isa, options.traversal, force_general);
                options.force_general = force_general;
                const Image<float> image = render<float>(scene, options);
                CHECK(pixels_off(image, truth) <= 1);
                if (options.isa == "sse42")
                    continue;
                if (!fused)
                    fused = image;
                CHECK((fused->rgb == image.rgb));
            }
    }
}

TEST_CASE("a far light's shadows do not move if a quadric has no bounds", "[no_cliff]")
{
    const std::string endless[] = {"saddle { translate = (0, 0, -30)  scale = (1, 1, 0.2) }",
                                   "cylinder { scale = 0.2  rotate = (1, 0, 0, 90)  "
                                   "translate = (0.5, 0, 1) }"};
    for (const std::string& quadric : endless)
        for (const double distance : {1e4, 1e6, 1e8}) {
            CAPTURE(quadric, distance);
            check_like_scalar(lit_from(distance, quadric), 2);
        }
}

TEST_CASE("a far light's shadows do not move if small bodies lie on a large ball", "[no_cliff]")
{
    const Scene scene = parse_scene(R"(image_size = 400 x 400  illumination = whitted
        camera { position = (0.00015, 0.00054, -0.00038)  look_at = (0, 0, 0)  fov = 52.7 }
        sphere { center = (0, -3.9723512, 0)  radius = 3.97205667  diffuse = 0.7 }
        cylinder { z_range = (-0.9, 0.8)  capped = true
                   scale = (6.39700681e-5, 4.2434e-5, 3.739065e-5)
                   rotate = (1, 0.532, 0.569, 164.57)
                   translate = (-0.00022908982, -2.23571908e-5, -0.0001430703)  diffuse = 0.7 }
        light { type = point  intensity = 0.5  position = (9.7592, 4.72690665, -9.43972355) })",
                                    "ball", {});
    check_like_scalar(scene, 4);
}

TEST_CASE("a far light's shadows do not move beside a second large ball", "[no_cliff]")
{
    const Scene scene = parse_scene(R"(image_size = 300 x 200  illumination = whitted
        camera { position = (-3, 4, -6)  look_at = (-1, 0, -0.5)  fov = 40 }
        sphere { center = (0, -1e5, 0)  radius = 1e5  diffuse = 0.7 }
        sphere { center = (0, 0, 0)  radius = 0.01  diffuse = 0.7 }
        sphere { center = (0, 0, 0)  radius = 1  diffuse = 0.7 }
        sphere { center = (-3e6, 0, 0)  radius = 1e6  diffuse = 0.7 }
        light { type = point  intensity = 0.5  position = (310000, 500000, 200000) })",
                                    "balls", {});
    check_like_scalar(scene, 4);
}

TEST_CASE("a light near one body and far from another keeps the near one's shadow", "[no_cliff]")
{
    const char* const scenes[] = {// A ball's shadow on a wall, with and without a speck beside.
                                  R"(image_size = 64 x 64  illumination = whitted
           camera { position = (0.123, 0.217, 0.0731)  look_at = (0.123, 0.217, 10)  fov = 60 }
           plane { point = (0, 0, 1e5)  normal = (0, 0, -1)  diffuse = 1 }
           sphere { center = (0.123, 0.217, 1.0731)  radius = 0.3  diffuse = 1 }
           sphere { center = (5, 0, 0)  radius = 0.0001  diffuse = 1 }
           light { type = point  position = (0.123, 0.517, 0.0731)  intensity = 1 })",
                                  R"(image_size = 64 x 64  illumination = whitted
           camera { position = (0.123, 0.217, 0.0731)  look_at = (0.123, 0.217, 10)  fov = 60 }
           plane { point = (0, 0, 1e6)  normal = (0, 0, -1)  diffuse = 1 }
           cylinder { scale = 0.1  rotate = (1, 0, 0, 90)  translate = (0.123, 0.217, 1.0731)
                      diffuse = 1 }
           light { type = point  position = (0.323, 0.217, 0.0731)  intensity = 1 })",
                                  // A lamp just below a ceiling, and a tiny sphere on the floor.
                                  R"(image_size = 64 x 64  illumination = whitted
           camera { position = (0.3, 0.1, -3)  look_at = (0.2, -0.5, 0)  fov = 70 }
           plane { point = (0, -1, 0)  normal = (0, 1, 0)  diffuse = 1 }
           plane { point = (0, 1.3, 0)  normal = (0, -1, 0)  diffuse = 0 }
           sphere { center = (0.5, -0.99995, 0.2)  radius = 0.00005  diffuse = 1 }
           light { type = point  position = (0.3, 1.2999999, 0.7)  intensity = 1 })"};
    for (const char* const text : scenes) {
        CAPTURE(text);
        check_like_scalar(parse_scene(text, "near", {}), 4);
    }
}

TEST_CASE("camera, lights and distant objects change no digit of a hit", "[no_cliff]")
{
    for (const std::string& isa : supported_isas())
        for (const lab::StressMode& mode : lab::stress_modes) {
            CAPTURE(isa, mode.name);
            check_no_cliff<float>({.isa = isa, .accuracy = mode.accuracy});
        }
}

TEST_CASE("camera, lights and distant objects change no digit of a hit in double or scalar",
          "[no_cliff]")
{
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        check_no_cliff<double>({.isa = isa});
    }
    check_no_cliff<double>({.kernel = Kernel::scalar});
}

}  // namespace packtrace::test
