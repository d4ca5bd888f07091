// The general equation, by hand and against the notes that reduce to it.
#include "catch.hpp"
#include "reference/render_reference.hpp"
#include "reference_scenes.hpp"

#include <algorithm>
#include <cmath>

namespace packtrace::test {
namespace {

using V = reference::Vec3<double>;

// Nested and overlapping glass, a mirror and a matt object, lit by two lights. `make` gives the
// material from ambient, diffuse, specular and transmitted share, and colour.
template <class Make>
Scene glass_scene(Illumination illumination, const Make& make)
{
    Scene scene{
        .width = 24, .height = 18, .background = Rgb(0.2, 0.3, 0.4), .illumination = illumination};
    scene.camera.position = Vec3(0, 0.5, -4);
    scene.camera.pixel_sample = Vec2(0.5, 0.5);
    scene.shadows = ShadowKind::transparent;
    scene.objects = {plane({0, -1, 0}, {0, 1, 0}, make(0.2, 0.6, 0.1, 0.0, Rgb(1, 0.8, 0.5))),
                     sphere({-0.6, 0, 0}, 1, make(0.0, 0.1, 0.2, 0.7, Rgb(0.5, 1, 1))),
                     sphere({0.5, 0, 0.2}, 0.8, make(0.0, 0.0, 0.1, 0.9, Rgb(1))),
                     sphere({-0.6, 0, 0}, 0.4, make(0.1, 0.7, 0.0, 0.0, Rgb(1, 0, 0))),
                     sphere({1, 1, 3}, 1, make(0.1, 0.1, 0.8, 0.0, Rgb(0, 0, 1)))};
    scene.lights = {ambient(0.3), point_light({2, 3, -2}, 0.7), directional({-1, 2, 0.3}, 0.4)};
    return scene;
}

Material general(double Ka, double Kd, double Ks, double Kt, const Rgb& color)
{
    return shaded(GeneralMaterial{color * Ka, color * Kd, Rgb(Ks), Rgb(Ks), Rgb(Kt), 20, 1.4});
}

Material sketch(double Ka, double Kd, double Ks, double Kt, const Rgb& color)
{
    return shaded(SketchMaterial{Rgb(Ka), Rgb(Kd), Rgb(Ks), Rgb(Kt), 20, 1.4}, color);
}

Material whitted(double Ka, double Kd, double Ks, double Kt, const Rgb& color)
{
    return shaded(WhittedMaterial{Rgb(Ka), Rgb(Kd), Rgb(Ks), Rgb(Kt), 20, 1.4}, color);
}

void require_same(const Image<double>& a, const Image<double>& b)
{
    REQUIRE(a.rgb.size() == b.rgb.size());
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        REQUIRE(std::abs(a.rgb[i] - b.rgb[i]) <= 1e-13);
}

}  // namespace

TEST_CASE("every coefficient has its term", "[reference_general]")
{
    // At the origin N = (0, 1, 0), V = (-0.6, 0.8, 0), L = (0, 1, 0), R.V = 0.8.
    GeneralMaterial model{.ambient = Rgb(0.1, 0, 0),
                          .diffuse = Rgb(0, 0.2, 0),
                          .highlight = Rgb(0, 0, 1),
                          .reflect = Rgb(0.5, 0, 0),
                          .transmit = Rgb(0, 0.5, 0),
                          .shininess = 2};
    Scene scene{.background = Rgb(1, 1, 1),
                .illumination = Illumination::general,
                .objects = {plane({0, 0, 0}, {0, 1, 0}, shaded(model, Rgb(7)))},
                .lights = {ambient(2), directional({0, 1, 0}, 0.5)}};
    const V org(-3, 4, 0);
    const V dir(3, -4, 0);
    check_color(trace(scene, org, dir), Rgb(0.2 + 0.5, 0.1 + 0.5, 0.32));
    scene.max_depth = 0;
    scene.depth_limit = DepthLimit::local;
    check_color(trace(scene, org, dir), Rgb(0.2, 0.1, 0.32));
    scene.depth_limit = DepthLimit::background;
    check_color(trace(scene, org, dir), Rgb(0.7, 0.6, 0.32));
}

TEST_CASE("total internal reflection adds the transmitted share to the mirror",
          "[reference_general]")
{
    // From inside the glass below y = 0, at 45 degrees: the reflected ray finds the red floor.
    GeneralMaterial glass{.reflect = Rgb(0.25), .transmit = Rgb(0.75), .ior = 1.5};
    GeneralMaterial red{.ambient = Rgb(1, 0, 0)};
    Scene scene{.background = Rgb(0, 0, 1),
                .illumination = Illumination::general,
                .objects = {plane({0, 0, 0}, {0, 1, 0}, shaded(glass)),
                            plane({0, -2, 0}, {0, 1, 0}, shaded(red))},
                .lights = {ambient(1)}};
    scene.camera.position = Vec3(0, -1, 0);
    check_color(trace(scene, {0, -1, 0}, {1, 1, 0}), Rgb(1, 0, 0));
    check_color(trace(scene, {0, -1, 0}, {0.5, 1, 0}), Rgb(0.25, 0, 0.75));
}

TEST_CASE("sketch is the equation with the background at the depth limit", "[reference_general]")
{
    for (const int depth : {0, 2, 5}) {
        Scene as_note = glass_scene(Illumination::sketch, sketch);
        Scene lowered = glass_scene(Illumination::general, general);
        as_note.max_depth = lowered.max_depth = depth;
        lowered.depth_limit = DepthLimit::background;
        // The note's highlights include those of lights behind a surface, the equation's do not.
        // Highlights this narrow never come from these lights.
        for (std::size_t i = 0; i < as_note.objects.size(); ++i) {
            std::get<SketchMaterial>(as_note.objects[i].material.model).shininess = 1e6;
            std::get<GeneralMaterial>(lowered.objects[i].material.model).shininess = 1e6;
        }
        require_same(render_reference<double>(as_note), render_reference<double>(lowered));
    }
}

TEST_CASE("whitted is the equation with the local light at the depth limit", "[reference_general]")
{
    for (const int depth : {0, 2, 5}) {
        Scene as_note = glass_scene(Illumination::whitted, whitted);
        Scene lowered = glass_scene(Illumination::general, general);
        as_note.max_depth = lowered.max_depth = depth;
        require_same(render_reference<double>(as_note), render_reference<double>(lowered));
    }
}

TEST_CASE("depth 20 with two children at every hit ends", "[reference_general]")
{
    Scene scene = glass_scene(Illumination::general, general);
    scene.width = scene.height = 4;
    scene.max_depth = 20;
    const Image<double> image = render_reference<double>(scene);
    for (const double value : image.rgb)
        CHECK(std::isfinite(value));
}

TEST_CASE("float and long double draw the glass scene alike", "[reference_general]")
{
    Scene scene = glass_scene(Illumination::general, general);
    const Image<float> single = render_reference<float>(scene);
    const Image<double> picture = render_reference<double>(scene);
    const Image<long double> exact = render_reference<long double>(scene);
    int off = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        REQUIRE(std::abs(static_cast<double>(exact.rgb[i]) - picture.rgb[i]) <= 1e-10);
        off += std::abs(static_cast<double>(single.rgb[i]) - picture.rgb[i]) > 1e-4 ? 1 : 0;
    }
    CHECK(off == 0);
}

TEST_CASE("a material of another model is refused by name", "[reference_general]")
{
    Scene scene = glass_scene(Illumination::whitted, sketch);
    scene.objects[0].name = "floor";
    CHECK_THROWS_WITH(render_reference<double>(scene), ContainsSubstring("'floor'"));
}

}  // namespace packtrace::test
