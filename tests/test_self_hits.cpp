// SelfHits::exact: packets against the scalar reference, both by that rule, and rays that leave a
// surface they start on.
#include "catch.hpp"
#include "lab/harness/ray_trees.hpp"
#include "lab/report/error_class.hpp"
#include "lab/stress/stress_family.hpp"
#include "packet_scenes.hpp"
#include "reference/render_reference.hpp"
#include "reference_scenes.hpp"
#include "render_scene.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace packtrace::test {
namespace {

RenderOptions exact_options(const std::string& isa = "auto")
{
    return {.isa = isa, .self_hits = SelfHits::exact};
}

template <class Real>
Image<Real> scalar_exact(const Scene& scene)
{
    return render_reference<Real>(scene, exact_options());
}

/// Calls `check` with a scene's picture by every kernel, in each accuracy and precision.
template <class Check>
void check_everywhere(const Scene& scene, const Check& check)
{
    check(scalar_exact<float>(scene));
    check(scalar_exact<double>(scene));
    check(scalar_exact<long double>(scene));
    for (const std::string& isa : supported_isas())
        for (const Accuracy accuracy : {Accuracy::fast, Accuracy::exact}) {
            CAPTURE(isa, static_cast<int>(accuracy));
            RenderOptions options = exact_options(isa);
            options.accuracy = accuracy;
            check(render<float>(scene, options));
            check(render<double>(scene, options));
        }
}

/// A glass ball inside a glass ball over a checkered floor: rays start on either side of surfaces.
Scene glass_balls(ShadowKind shadows)
{
    Scene scene;
    set_size(scene, 61, 47);
    scene.illumination = Illumination::whitted;
    scene.shadows = shadows;
    scene.max_depth = 6;
    WhittedMaterial glass{.specular = Rgb(0.2), .transmissive = Rgb(0.8), .ior = 1.5};
    WhittedMaterial stone{.diffuse = Rgb(0.7), .specular = Rgb(0.1)};
    for (const double radius : {1.0, 0.6})
        scene.objects.push_back(lab::sphere_object({0.1, 0.0, 4.0}, radius));
    scene.objects.push_back(lab::sphere_object({0.0, -501.0, 4.0}, 500.0));
    for (Object& object : scene.objects)
        object.material.model = glass;
    scene.objects[2].material.model = stone;
    scene.lights = {ambient(0.2), point_light({3, 5, -2}, 0.7), directional({-1, 2, -1}, 0.3)};
    return scene;
}

/// A ray from a point on the unit ball's surface; `side` is the value for StartsView.
struct Leaving {
    float t = 0.0f;
    std::int32_t object = -2;
};

Leaving leave_ball(const RayScene<float>& scene, const glm::vec3& org, const glm::vec3& point,
                   const glm::vec3& dir, std::int32_t side)
{
    const float zero = 0.0f;
    const float far = 1e9f;
    Leaving found;
    scene.closest_hits({&org.x, &org.y, &org.z, &dir.x, &dir.y, &dir.z, &zero, &far, 1},
                       {{&point.x, &point.y, &point.z}, &side}, {&found.t, &found.object});
    return found;
}

}  // namespace

TEST_CASE("by the exact rule packets of doubles give the double reference's picture", "[self_hits]")
{
    for (const NamedScene& named : packet_scenes()) {
        const Image<double> expected = scalar_exact<double>(named.scene);
        for (const std::string& isa : supported_isas()) {
            CAPTURE(named.name, isa);
            const auto picture = render<double>(named.scene, exact_options(isa));
            CHECK(compare(picture, expected).max_abs <= 1e-9);
        }
    }
}

TEST_CASE("the exact rule applies to rays in glass, in packets and in the reference", "[self_hits]")
{
    for (const ShadowKind shadows : {ShadowKind::none, ShadowKind::opaque, ShadowKind::transparent})
        for (const Traversal traversal : {Traversal::list, Traversal::tree}) {
            const Scene scene = glass_balls(shadows);
            const Image<double> expected = scalar_exact<double>(scene);
            for (const std::string& isa : supported_isas()) {
                CAPTURE(static_cast<int>(shadows), static_cast<int>(traversal), isa);
                RenderOptions options = exact_options(isa);
                options.traversal = traversal;
                CHECK(compare(render<double>(scene, options), expected).max_abs <= 1e-9);
            }
        }
}

TEST_CASE("by the note's rule nothing shadows a light closer than 0.001", "[self_hits]")
{
    // A ball behind the light, seen from a floor closer than 0.001 to the light.
    Scene scene;
    set_size(scene, 32, 32);
    scene.illumination = Illumination::whitted;
    scene.max_depth = 0;
    WhittedMaterial stone{.diffuse = Rgb(0.7)};
    scene.objects = {lab::plane_object({0, 0, 0}, {0, 1, 0}),
                     lab::sphere_object({0, 0.0012, 0}, 0.0006)};
    for (Object& object : scene.objects)
        object.material.model = stone;
    scene.lights = {point_light({0, 0.0004, 0}, 1.0)};
    scene.camera.position = {0, 0.0005, -0.005};
    scene.camera.rotation = look_at(scene.camera.position, {0, 0, 0}, {0, 1, 0});
    scene.camera.fov = 20;
    RenderOptions options{.self_hits = SelfHits::note};
    const Image<double> expected = render_reference<double>(scene, options);
    for (const Traversal traversal : {Traversal::list, Traversal::tree})
        for (const std::string& isa : supported_isas()) {
            CAPTURE(static_cast<int>(traversal), isa);
            options.isa = isa;
            options.traversal = traversal;
            CHECK(compare(render<double>(scene, options), expected).max_abs <= 1e-9);
            for (const Accuracy accuracy : {Accuracy::fast, Accuracy::exact}) {
                options.accuracy = accuracy;
                const auto single = convert<double>(render<float>(scene, options));
                CHECK(compare(single, expected).max_abs <= 1e-3);
            }
        }
}

TEST_CASE("by the note's rule a lamp at any distance casts the right shadows", "[self_hits]")
{
    const Scene scene = parse_scene(
        "image_size = 256 x 256  sphere { center = (-0.7, 0.5, 4.1)  radius = 0.6 } "
        "plane { point = (0, -1, 3)  normal = (0.15, 1, 0.08) } "
        "light { type = point  intensity = 0.7  position = (2650, 3000, -3000) }",
        "far lamp", {});
    RenderOptions options{.accuracy = Accuracy::fast, .self_hits = SelfHits::note};
    const Image<double> truth = render_reference<double>(scene, {.self_hits = SelfHits::note});
    for (const std::string& isa : supported_isas())
        for (const Traversal traversal : {Traversal::list, Traversal::tree}) {
            CAPTURE(isa, static_cast<int>(traversal));
            options.isa = isa;
            options.traversal = traversal;
            const auto picture = render<float>(scene, options);
            // The shadow's edge is computed in float.
            CHECK(compare(convert<double>(picture), truth).pixels_off <= 4);
        }
}

TEST_CASE("by the exact rule four spheres differ from long double only at edges", "[self_hits]")
{
    const Scene scene = four_spheres(192, 192);
    const Image<long double> wide = scalar_exact<long double>(scene);
    Image<double> truth(scene.width, scene.height);
    std::copy(wide.rgb.begin(), wide.rgb.end(), truth.rgb.begin());
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        const auto picture = convert<double>(render<float>(scene, exact_options(isa)));
        CHECK(compare(picture, truth).pixels_off <= 2);
    }
}

TEST_CASE("a ray that touches a ball to the last digit is mirrored off its outer side",
          "[self_hits]")
{
    Scene scene = read_scene(PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene");
    scene.width = scene.height = 640;
    for (const int column : {64, 576}) {
        const auto color = reference::Reference<double>(scene).trace_pixel(column, 255);
        const auto truth = reference::Reference<long double>(scene).trace_pixel(column, 255);
        check_color(color,
                    Rgb(static_cast<double>(truth.x), static_cast<double>(truth.y),
                        static_cast<double>(truth.z)),
                    1e-7);
    }
}

TEST_CASE("where the gradient vanishes the normal points against the ray, in every kernel",
          "[self_hits]")
{
    const Scene cone = parse_scene(
        "illumination = general  image_size = 3 x 3  camera { position = (0, 0, -5) }"
        "light { type = point position = (0, 0, -3) intensity = 1 }"
        "light { type = ambient intensity = 1 }"
        "cone { rotate = (1, 0, 0, 90) ambient = 0.25 diffuse = 0.5 }",
        "cone");
    // The eye is on the cone's apex: rays start there, and so do mirrored rays and shadow rays.
    Scene inside = parse_scene(
        "illumination = whitted  image_size = 100 x 100  ellipsoid { specular = 0.5 }  cone { }"
        "light { type = directional intensity = 1 direction = (0, 1, -1.36) }",
        "inside");
    const auto check = [](const auto& image) {
        int bad = 0;
        for (const auto value : image.rgb)
            bad += !std::isfinite(value);
        CHECK(bad == 0);
    };
    const auto check_middle = [&](const auto& image) {
        check(image);
        CHECK(static_cast<double>(image.pixel(1, 1)[0]) == Approx(0.75));
    };
    check_everywhere(cone, check_middle);
    check_everywhere(inside, check);
}

TEST_CASE("a ray along the axis from a cone's apex does not hit the cone again", "[self_hits]")
{
    const std::string place = GENERATE("", "translate = (0.25, -0.75, 1.125)");
    CAPTURE(place);
    const Scene scene = parse_scene(
        "illumination = general  image_size = 1 x 1  max_depth = 4  camera { position = " +
            std::string(place.empty() ? "(0, 0, -3)" : "(0.25, -0.75, -1.875)") +
            " } light { type = ambient intensity = 1 }"
            "cone { ambient = 0.25 reflect = 0.5 " +
            place + " }",
        "apex");
    check_everywhere(
        scene, [](const auto& image) { CHECK(static_cast<double>(image.pixel(0, 0)[0]) == 0.25); });
}

TEST_CASE("a ray along the axis from a capped cone's apex hits the cap behind it", "[self_hits]")
{
    const std::string cone = GENERATE("cone { z_range = (-2, 2)", "cone { z_range = (-2, 0.5)",
                                      "cone { z_range = (-2, 2) scale = (3, 0.125, 1)");
    CAPTURE(cone);
    const Scene scene = parse_scene(
        "illumination = general  image_size = 1 x 1  max_depth = 4  "
        "camera { position = (0, 0, -1) } light { type = ambient intensity = 1 }" +
            cone + " capped = yes ambient = 0.25 reflect = 0.5 }",
        "capped");
    // The apex, then the cap behind the eye, and so on.
    check_everywhere(scene, [](const auto& image) {
        CHECK(static_cast<double>(image.pixel(0, 0)[0]) == 0.484375);
    });
}

TEST_CASE("a ray that only touches a body of glass enters and leaves it once", "[self_hits]")
{
    const std::string body = GENERATE(
        "sphere { center = (1, 0, 5) radius = 1",
        "cone { rotate = (1, 0, 0, 90) translate = (0, 0, 5)",
        "cone { z_range = (-1, 1) capped = yes rotate = (1, 0, 0, 90) translate = (0, 0, 5)");
    CAPTURE(body);
    const Scene scene = parse_scene(
        "illumination = general  image_size = 1 x 1  max_depth = 6  background = rgb(0.5, 0.5, "
        "0.5) "
        "light { type = ambient intensity = 1 }" +
            body + " ambient = 0.125 transmit = 1 ior = 1 }",
        "touched");
    check_everywhere(
        scene, [](const auto& image) { CHECK(static_cast<double>(image.pixel(0, 0)[0]) == 0.75); });
}

TEST_CASE("a ray that leaves a ball hits it again only from inside, at however small an angle",
          "[self_hits]")
{
    Scene scene{.objects = {lab::sphere_object({0, 0, 0}, 1.0)}};
    const RayScene<float> balls(scene, exact_options());
    const glm::vec3 top{0, 1, 0};
    for (const float fall : {0.5f, 1e-2f, 1e-4f, 1e-6f}) {
        CAPTURE(fall);
        const glm::vec3 down{std::sqrt(1.0f - fall * fall), -fall, 0};
        const glm::vec3 up{down.x, fall, 0};
        // The start itself does not count as a hit, even without an offset from the surface.
        const Leaving inside = leave_ball(balls, top, top, down, ~0);
        CHECK(inside.object == 0);
        CHECK(inside.t == Approx(2.0f * fall));
        CHECK(leave_ball(balls, top, top, up, 0).object == -1);
        // Rounding puts the start a little outside or inside, with any direction: the side decides.
        const glm::vec3 off{0, 1.0000002f, 0};
        CHECK(leave_ball(balls, off, off, down, 0).object == -1);
        CHECK(leave_ball(balls, off, off, up, ~0).object == 0);
    }
    CHECK(leave_ball(balls, {0, 3, 0}, {0, 0, 0}, {0, -1, 0}, no_start).t == 2.0f);
}

TEST_CASE("a ray from a saddle hits it again where the saddle curves towards the ray",
          "[self_hits]")
{
    Scene scene;
    Object object{.surface = Quadric{.kind = QuadricKind::saddle,
                                     .coefficients = {1, -1, 0, 0, 0, 0, 0, 0, -1, 0}}};
    scene.objects = {object};
    const RayScene<float> scenes(scene, exact_options());
    // z = x² - y²: from (1, 0, 1) along -x + 0.5 z: x = 1 - t, z = 1 + t/2, t² - 2.5 t = 0.
    const glm::vec3 start{1, 0, 1};
    for (const std::int32_t side : {0, ~0}) {
        const Leaving found = leave_ball(scenes, start, start, {-1, 0, 0.5f}, side);
        // Only one of the sides is the side that the ray enters; z above x² - y² is inside.
        CHECK(found.object == (side == 0 ? -1 : 0));
        if (side != 0)
            CHECK(found.t == Approx(2.5f));
    }
}

TEST_CASE("a ray hits the nearer of two spheres after leaving one, by lists and by a bvh",
          "[self_hits]")
{
    constexpr std::size_t count = 300;
    for (const double gap : {1e-5, 1e-6, 1e-7, 1e-9, 1e-12})
        for (const bool moved : {false, true}) {
            const Scene scene{.objects = {lab::sphere_object({0, 0, 0}, 1.0),
                                          moved ? lab::sphere_object({0, 0, gap}, 1.0)
                                                : lab::sphere_object({0, 0, 0}, 1.0 - gap)}};
            // Inwards from the first sphere, most at a small angle to its surface.
            std::mt19937 random(21);
            std::uniform_real_distribution<double> unit(-1.0, 1.0);
            std::array<std::vector<float>, 3> point, org, dir;
            for (std::size_t i = 0; i < count; ++i) {
                const Vec3 out = glm::normalize(Vec3(unit(random), unit(random), unit(random)));
                const Vec3 along = glm::cross(out, Vec3(unit(random), unit(random), unit(random)));
                const Vec3 way = along - std::pow(10.0, 1.5 * unit(random) - 1.5) * out;
                for (int axis = 0; axis < 3; ++axis) {
                    const auto of = static_cast<std::size_t>(axis);
                    point[of].push_back(static_cast<float>(out[axis]));
                    org[of].push_back(static_cast<float>(out[axis] * (1.0 - 0x1p-22)));
                    dir[of].push_back(static_cast<float>(way[axis]));
                }
            }
            const std::vector<float> t_min(count, 0.0f);
            const std::vector<float> t_max(count, 1e9f);
            const std::vector<std::int32_t> side(count, ~0);
            std::vector<float> t[2];
            std::vector<std::int32_t> object[2];
            for (const std::string& isa : supported_isas()) {
                CAPTURE(gap, moved, isa);
                for (const Traversal traversal : {Traversal::list, Traversal::tree}) {
                    const int by = traversal == Traversal::list ? 0 : 1;
                    t[by].assign(count, 0.0f);
                    object[by].assign(count, -2);
                    RenderOptions options = exact_options(isa);
                    options.traversal = traversal;
                    RayScene<float>(scene, options)
                        .closest_hits(
                            {org[0].data(), org[1].data(), org[2].data(), dir[0].data(),
                             dir[1].data(), dir[2].data(), t_min.data(), t_max.data(), count},
                            {{point[0].data(), point[1].data(), point[2].data()}, side.data()},
                            {t[by].data(), object[by].data()});
                }
                CHECK(t[0] == t[1]);
                CHECK(object[0] == object[1]);
                CHECK(std::count(object[0].begin(), object[0].end(), 1) > 0);
                if (moved)
                    CHECK(std::count(object[0].begin(), object[0].end(), 0) > 0);
            }
        }
}

}  // namespace packtrace::test
