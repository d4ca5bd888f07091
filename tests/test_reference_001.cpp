// Note 001 against numbers computed by hand from its text.
#include "catch.hpp"
#include "reference/models/note_001.hpp"
#include "reference/render_reference.hpp"
#include "reference_scenes.hpp"
#include <packtrace/scene.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace packtrace::test {
namespace {

using V = reference::Vec3<double>;

constexpr double inf = reference::infinity<double>;

// The note's listing with its missing radii. The picture size avoids canvas points like (-0.4,
// 0.1), where the ray touches the blue sphere and the square root halves the number of digits.
Scene note_spheres()
{
    const auto shiny = [](const Rgb& color, double specular, double reflective) {
        Material material;
        material.color = color;
        material.model = ScratchMaterial{specular, reflective};
        return material;
    };
    return {.width = 38,
            .height = 38,
            .objects = {sphere({0, -1, 3}, 1, shiny({1, 0, 0}, 500, 0.2)),
                        sphere({-2, 1, 3}, 1, shiny({0, 0, 1}, 500, 0.3)),
                        sphere({2, 1, 3}, 1, shiny({0, 1, 0}, 10, 0.4)),
                        sphere({0, -5001, 0}, 5000, shiny({1, 1, 0}, 1000, 0.5))},
            .lights = {ambient(0.2), point_light({2, 1, 0}, 0.6), directional({1, 4, 4}, 0.2)}};
}

V light_at(const Scene& scene, const V& P, const V& N, const V& view, double s)
{
    const reference::World<double> world(scene);
    return reference::Note001<double>(scene, world).compute_lighting(P, N, view, s);
}

}  // namespace

TEST_CASE("a ray through a sphere's centre hits it a radius before and after", "[reference_001]")
{
    const reference::SphereBody<double> unit{{0, 0, 3}, 1, 0};
    CHECK(intersect_ray_sphere(V(0, 0, 0), V(0, 0, 1), unit) == std::pair(4.0, 2.0));
    CHECK(intersect_ray_sphere(V(0, 0, 0), V(0, 0, 2), unit) == std::pair(2.0, 1.0));
    CHECK(intersect_ray_sphere(V(0, 1, 0), V(0, 0, 1), unit) == std::pair(3.0, 3.0));
    CHECK(intersect_ray_sphere(V(0, 2, 0), V(0, 0, 1), unit) == std::pair(inf, inf));
}

TEST_CASE("a ray hits a plane at n.(point - O) / n.D, and a parallel one never", "[reference_001]")
{
    const reference::PlaneBody<double> floor{{7, -1, 9}, {0, 1, 0}, 0};
    CHECK(intersect_ray_plane(V(0, 2, 0), V(1, -0.5, 0), floor) == 6.0);
    CHECK(std::isinf(intersect_ray_plane(V(0, 2, 0), V(1, 0, 0), floor)));
    CHECK(std::isnan(intersect_ray_plane(V(0, -1, 0), V(1, 0, 0), floor)));
}

TEST_CASE("lighting adds ambient, diffuse and highlight of each light", "[reference_001]")
{
    // Point light: L = (3, 4, 0), N.L/|L| = 0.8, R = (-3, 4, 0), R.V/(|R||V|) = 0.8.
    Scene scene{.lights = {ambient(0.2), point_light({3, 4, 0}, 0.6), directional({0, 5, 0}, 0.2)}};
    check_color(light_at(scene, {0, 0, 0}, {0, 1, 0}, {0, 3, 0}, -1), Rgb(0.2 + 0.48 + 0.2));
    check_color(light_at(scene, {0, 0, 0}, {0, 1, 0}, {0, 3, 0}, 2),
                Rgb(0.2 + 0.48 + 0.2 + 0.6 * 0.64 + 0.2));
}

TEST_CASE("a coloured light works on each channel alone", "[reference_001]")
{
    Scene scene{.lights = {{LightType::directional, Rgb(1.0, 0.5, 0.0), Vec3(3, 4, 0)}}};
    check_color(light_at(scene, {0, 0, 0}, {0, 1, 0}, {0, 1, 0}, -1), Rgb(0.8, 0.4, 0.0));
}

TEST_CASE("a light behind the surface makes a highlight too", "[reference_001]")
{
    // N.L = -4, R = (-3, -4, 0), R.V/|R| = 0.6.
    Scene scene{.lights = {directional({3, -4, 0}, 0.5)}};
    check_color(light_at(scene, {0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, 1), Rgb(0.3));
}

TEST_CASE("a ray that hits nothing gets the background", "[reference_001]")
{
    Scene scene = note_spheres();
    scene.background = Rgb(0.1, 0.2, 0.3);
    check_color(trace(scene, {0, 0, 0}, {0, 1, 0}), scene.background);
}

TEST_CASE("local and reflected colour blend as local*(1-r) + reflected*r", "[reference_001]")
{
    // Perpendicular to the mirror the ray turns back: background, or the green sphere behind the
    // eye.
    Scene scene{.background = Rgb(0.8, 0.4, 0.0),
                .objects = {sphere({0, 0, 3}, 1, matte(Rgb(1), 0.25))},
                .lights = {ambient(0.5)}};
    check_color(trace(scene, {0, 0, 0}, {0, 0, 1}), Rgb(0.575, 0.475, 0.375));
    scene.objects.push_back(sphere({0, 0, -5}, 1, matte(Rgb(0, 1, 0))));
    check_color(trace(scene, {0, 0, 0}, {0, 0, 1}), Rgb(0.375, 0.5, 0.375));
}

TEST_CASE("at the depth limit the local colour counts whole", "[reference_001]")
{
    Scene scene{.max_depth = 0,
                .objects = {sphere({0, 0, 3}, 1, matte(Rgb(1), 0.5)),
                            sphere({0, 0, -5}, 1, matte(Rgb(0, 1, 0), 0.5))},
                .lights = {ambient(0.5)}};
    check_color(trace(scene, {0, 0, 0}, {0, 0, 1}), Rgb(0.5));
    scene.max_depth = 1;
    check_color(trace(scene, {0, 0, 0}, {0, 0, 1}), Rgb(0.25, 0.5, 0.25));
    scene.max_depth = 2;
    check_color(trace(scene, {0, 0, 0}, {0, 0, 1}), Rgb(0.375, 0.5, 0.375));
}

TEST_CASE("an occluder before the light shadows, one behind a point light does not",
          "[reference_001]")
{
    Scene scene{.objects = {plane({0, -1, 0}, {0, 1, 0}, matte(Rgb(1))),
                            sphere({0, 1, 0}, 0.5, matte(Rgb(1)))},
                .lights = {point_light({0, 3, 0}, 1)}};
    const V O(0, 0, 0);
    const V D(0, -1, 0);
    check_color(trace(scene, O, D), Rgb(0));
    scene.shadows = ShadowKind::none;
    check_color(trace(scene, O, D), Rgb(1));
    scene.shadows = ShadowKind::opaque;
    scene.objects[1] = sphere({0, 5, 0}, 0.5, matte(Rgb(1)));
    check_color(trace(scene, O, D), Rgb(1));
    scene.lights = {directional({0, 1, 0}, 1)};
    check_color(trace(scene, O, D), Rgb(0));
}

TEST_CASE("camera rays begin at the projection plane, the plane included", "[reference_001]")
{
    Scene scene;
    scene.width = scene.height = 2;
    scene.lights = {point_light({0, 0, 3}, 1)};
    const auto middle = [&] { return reference::Reference<double>(scene).trace_pixel(1, 0); };
    // Of the roots 0.5 and 1.5 only the second is past the plane. A sphere's normal stays outward,
    // so the light behind reaches it; a plane's normal turns to the viewer, so the light does not.
    scene.objects = {sphere({0, 0, 1}, 0.5, matte(Rgb(1)))};
    check_color(middle(), Rgb(1));
    scene.objects = {plane({0, 0, 1.5}, {0, 0, 1}, matte(Rgb(1)))};
    check_color(middle(), Rgb(0));
    scene.lights = {point_light({0, 0, 0}, 1)};
    check_color(middle(), Rgb(1));
    scene.objects = {sphere({0, 0, 2}, 1, matte(Rgb(0, 1, 0)))};
    check_color(middle(), Rgb(0, 1, 0));
}

TEST_CASE("squares of a checker change at multiples of their size", "[reference_001]")
{
    Scene scene;
    Material material = matte(Rgb(1));
    material.checker = Checker{Rgb(0), 2.0};
    scene.objects = {plane({0, -1, 0}, {0, 1, 0}, material)};
    scene.lights = {ambient(1)};
    const auto at = [&](double x, double z) { return trace(scene, {x, 0, z}, {0, -1, 0}).x; };
    CHECK(at(1, 1) == 1);
    CHECK(at(3, 1) == 0);
    CHECK(at(3, 3) == 1);
    CHECK(at(-1, 1) == 0);
    CHECK(at(-1, -1) == 1);
    // A matrix scales the squares: twice as wide in x.
    scene.objects[0].transform[0][0] = 2.0;
    CHECK(at(3, 1) == 1);
    CHECK(at(5, 1) == 0);
}

TEST_CASE("a sphere under a matrix keeps t and takes its normal by the inverse transpose",
          "[reference_001]")
{
    // Semi-axes 2, 1, 1 around (5, 0, 0).
    Scene scene{.objects = {sphere({0, 0, 0}, 1, matte(Rgb(1)))}};
    scene.objects[0].transform[0][0] = 2.0;
    scene.objects[0].transform[3] = {5, 0, 0, 1};
    const reference::Bodies<double> bodies(scene);
    const auto hit = closest_intersection(bodies, V(-1, 0, 0), V(2, 0, 0), 0.001, inf);
    CHECK(hit.object == 0);
    CHECK(hit.t == 2.0);
    // The point (0.6, 0.8, 0) of object space is (6.2, 0.8, 0); the gradient there is (1.2/4, 0.8,
    // 0).
    const V N = facing(bodies, hit, V(6.2, 0.8, 0), V(2, 0, 0)).outward;
    const double size = std::hypot(0.3, 0.8);
    check_color(N, Rgb(0.3 / size, 0.8 / size, 0));
}

TEST_CASE("the lower object number wins at equal t, whatever the surfaces", "[reference_001]")
{
    Scene scene{
        .objects = {plane({0, 0, 2}, {0, 0, 1}), sphere({0, 0, 3}, 1), sphere({0, 0, 3}, 1)}};
    const reference::Bodies<double> bodies(scene);
    CHECK(closest_intersection(bodies, V(0, 0, 0), V(0, 0, 1), 1.0, inf).object == 0);
    std::swap(scene.objects[0], scene.objects[2]);
    CHECK(closest_intersection(reference::Bodies<double>(scene), V(0, 0, 0), V(0, 0, 1), 1.0, inf)
              .object == 0);
}

TEST_CASE("double hits a ground of radius 5000 where long double does", "[reference_001]")
{
    using Wide = reference::Vec3<long double>;
    Scene scene{.objects = {sphere({0, -5001, 0}, 5000)}};
    const reference::Bodies<double> bodies(scene);
    const reference::Bodies<long double> wide(scene);
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
        const V O(0.3 - 0.001 * i, 0.1, 0.0007 * i);
        const V D(0.1 * (i % 7) - 0.3, -0.02 - 0.001 * i, 0.13 * (i % 11) - 0.7);
        const auto hit = closest_intersection(bodies, O, D, 0.0, inf);
        const auto truth =
            closest_intersection(wide, Wide(O), Wide(D), 0.0L, reference::infinity<long double>);
        REQUIRE(hit.object == 0);
        worst = std::max(worst, std::abs(hit.t / static_cast<double>(truth.t) - 1));
    }
    CHECK(worst <= 1e-15);
}

TEST_CASE("the middle of the note's picture is the red sphere's topmost point", "[reference_001]")
{
    // Canvas (0, 0) touches the red sphere at (0, 0, 3) with N = (0, 1, 0). Both lights reach that
    // point: N.L/|L| is 1/sqrt(14) and 4/sqrt(33), and the highlights vanish. The mirrored ray
    // continues along z into the black background, with weight 0.2.
    const double local = 0.2 + 0.6 / std::sqrt(14.0) + 0.2 * 4 / std::sqrt(33.0);
    const Scene scene = note_spheres();
    check_color(reference::Reference<double>(scene).trace_pixel(19, 18), Rgb(0.8 * local, 0, 0));
    check_color(reference::Reference<long double>(scene).trace_pixel(19, 18),
                Rgb(0.8 * local, 0, 0));
    check_color(reference::Reference<float>(scene).trace_pixel(19, 18), Rgb(0.8 * local, 0, 0),
                1e-6);
}

TEST_CASE("float, double and long double draw the same picture", "[reference_001]")
{
    Scene scene = note_spheres();
    const Image<double> picture = render_reference<double>(scene);
    const Image<long double> exact = render_reference<long double>(scene);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i)
        REQUIRE(std::abs(static_cast<double>(exact.rgb[i]) - picture.rgb[i]) <= 1e-9);
    // The ground's radius is too large for any formula in float; without the ground the pictures
    // agree.
    scene.objects.pop_back();
    const Image<double> without_ground = render_reference<double>(scene);
    const Image<float> single = render_reference<float>(scene);
    for (std::size_t i = 0; i < single.rgb.size(); ++i)
        REQUIRE(std::abs(static_cast<double>(single.rgb[i]) - without_ground.rgb[i]) <= 2e-3);
}

TEST_CASE("the picture does not depend on threads, and progress ends at one", "[reference_001]")
{
    const Scene scene = note_spheres();
    double last = 0;
    const auto watch = [&](double share) {
        CHECK(share > last);
        last = share;
    };
    const auto one = render_reference<double>(scene, {.threads = 1, .progress = watch});
    CHECK(last == 1.0);
    CHECK(render_reference<double>(scene, {.threads = 3}).rgb == one.rgb);
    const auto color = reference::Reference<double>(scene).trace_pixel(7, 30);
    CHECK(one.pixel(7, 30)[0] == color.x);
    CHECK(one.pixel(7, 30)[2] == color.z);
}

}  // namespace packtrace::test
