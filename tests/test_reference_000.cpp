// Note 000 against numbers computed by hand from its text.
#include "catch.hpp"
#include "reference_scenes.hpp"

#include <cmath>

namespace packtrace::test {
namespace {

using V = reference::Vec3<double>;

Scene sketch_scene()
{
    return {.illumination = Illumination::sketch, .max_depth = 4};
}

// The floor y = 0 as seen by a ray to the origin with N.V = 0.8 and flec = (0.6, 0.8, 0).
Scene floor_scene()
{
    SketchMaterial model{
        .ambient = Rgb(0.1), .diffuse = Rgb(0.5), .specular = Rgb(0.25), .shininess = 2.0};
    Scene scene = sketch_scene();
    scene.objects = {plane({0, 0, 0}, {0, 1, 0}, shaded(model, Rgb(1.0, 0.5, 0.0)))};
    scene.lights = {ambient(0.2), directional({0, 3, 0}, 1)};
    return scene;
}

const V floor_org(-3, 4, 0);
const V floor_dir(3, -4, 0);

SketchMaterial glass(double specular, double refractive)
{
    return {.specular = Rgb(specular), .refractive = Rgb(refractive), .ior = 1.5};
}

}  // namespace

TEST_CASE("dull is Kd lsou N.L + Ks lsou (flec.L)^S + Ka ambi", "[reference_000]")
{
    // Ka ambi = 0.02 and Kd N.L = 0.5, both times the colour; Ks 0.8^2 = 0.16, white.
    check_color(trace(floor_scene(), floor_org, floor_dir), Rgb(0.68, 0.42, 0.16));
}

TEST_CASE("a shadow leaves only the ambient part", "[reference_000]")
{
    Scene scene = floor_scene();
    scene.objects.push_back(sphere({0, 5, 0}, 1, shaded(SketchMaterial{})));
    check_color(trace(scene, floor_org, floor_dir), Rgb(0.02, 0.01, 0));
    scene.objects.back() = sphere({0, 5, 9}, 1, shaded(SketchMaterial{}));
    check_color(trace(scene, floor_org, floor_dir), Rgb(0.68, 0.42, 0.16));
}

TEST_CASE("a light behind the surface takes nothing away", "[reference_000]")
{
    Scene scene = floor_scene();
    scene.lights[1] = directional({-1, -1, 0}, 1);
    check_color(trace(scene, floor_org, floor_dir), Rgb(0.02, 0.01, 0));
}

TEST_CASE("the mirror adds Ks times what it sees", "[reference_000]")
{
    Scene scene = floor_scene();
    scene.background = Rgb(0, 0, 1);
    check_color(trace(scene, floor_org, floor_dir), Rgb(0.68, 0.42, 0.16 + 0.25));
}

TEST_CASE("a ray that escapes parallel to L sees the light itself", "[reference_000]")
{
    Scene scene = sketch_scene();
    scene.background = Rgb(0.1, 0.2, 0.3);
    scene.lights = {ambient(1), {LightType::directional, Rgb(2, 3, 4), Vec3(0, 0, 5)}};
    check_color(trace(scene, {7, 8, 9}, {0, 0, 2}), Rgb(2, 3, 4));
    check_color(trace(scene, {7, 8, 9}, {0, 0, -2}), scene.background);
    check_color(trace(scene, {7, 8, 9}, {0.0009, 0, 1}), Rgb(2, 3, 4));
    check_color(trace(scene, {7, 8, 9}, {0.0011, 0, 1}), scene.background);
    scene.lights = {{LightType::point, Rgb(2, 3, 4), Vec3(0, 0, 5)}};
    check_color(trace(scene, {0, 0, 1}, {0, 0, 2}), Rgb(2, 3, 4));
    check_color(trace(scene, {0, 1, 1}, {0, 0, 2}), scene.background);
}

TEST_CASE("a mirror shows the light in addition to its highlight", "[reference_000]")
{
    // flec runs along L: Ks lsou from the mirror and Ks lsou 1^S from the highlight, N.L = 0.8.
    Scene scene = floor_scene();
    scene.lights = {directional({3, 4, 0}, 1)};
    check_color(trace(scene, floor_org, floor_dir),
                Rgb(0.4 + 0.25 + 0.25, 0.2 + 0.25 + 0.25, 0.25 + 0.25));
}

TEST_CASE("depth 5 is the last to be seen, then comes the background", "[reference_000]")
{
    // Between two facing mirrors each level adds Ka ambi = 0.1.
    SketchMaterial model{.ambient = Rgb(0.1), .specular = Rgb(1)};
    Scene scene = sketch_scene();
    scene.background = Rgb(0.5);
    scene.objects = {plane({0, 0, 1}, {0, 0, 1}, shaded(model)),
                     plane({0, 0, -1}, {0, 0, 1}, shaded(model))};
    scene.lights = {ambient(1)};
    check_color(trace(scene, {0, 0, 0}, {0, 0, 1}), Rgb(5 * 0.1 + 0.5));
    scene.max_depth = 0;
    check_color(trace(scene, {0, 0, 0}, {0, 0, 1}), Rgb(0.1 + 0.5));
}

TEST_CASE("if Ks + Kr = 1 a bright surrounding is seen undimmed", "[reference_000]")
{
    Scene scene = sketch_scene();
    scene.background = Rgb(1);
    scene.objects = {sphere({0, 0, 0}, 1, shaded(glass(0.25, 0.75))),
                     sphere({0.3, 0, 0}, 0.4, shaded(glass(0, 1))),
                     plane({0, -1, 0}, {0, 1, 0}, shaded(glass(0.5, 0.5)))};
    for (const int depth : {0, 1, 4, 9}) {
        scene.max_depth = depth;
        for (int i = 0; i < 40; ++i)
            check_color(trace(scene, {-3, 0, 0}, {3, 0.05 * i - 1, 0.3}), Rgb(1));
    }
}

TEST_CASE("with Kr and transparent shadows an occluder passes Kr on", "[reference_000]")
{
    Scene scene = floor_scene();
    scene.shadows = ShadowKind::transparent;
    scene.objects.push_back(sphere({0, 5, 0}, 1, shaded(glass(0, 0.5))));
    check_color(trace(scene, floor_org, floor_dir),
                Rgb(0.02 + 0.25 + 0.08, 0.01 + 0.125 + 0.08, 0.08));
}

}  // namespace packtrace::test
