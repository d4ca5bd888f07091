// Note 002 against numbers computed by hand from its formula.
#include "catch.hpp"
#include "reference_scenes.hpp"

#include <cmath>

namespace packtrace::test {
namespace {

using V = reference::Vec3<double>;

WhittedMaterial clear(const Rgb& transmissive)
{
    return {.transmissive = transmissive};
}

// The floor y = 0 seen from (-3, 4, 0), hit at the origin with V = (-0.6, 0.8, 0).
Scene whitted_floor()
{
    WhittedMaterial model{
        .ambient = Rgb(0.5), .diffuse = Rgb(0.4), .specular = Rgb(0.3), .shininess = 3.0};
    return {.illumination = Illumination::whitted,
            .objects = {plane({0, 0, 0}, {0, 1, 0}, shaded(model, Rgb(1.0, 0.5, 0.0)))},
            .lights = {ambient(0.2), point_light({0, 4, 0}, 1)}};
}

}  // namespace

TEST_CASE("the formula with one light overhead", "[reference_002]")
{
    // Ia = 0.1 and kd N.L = 0.4, times the colour; Rj = (0, 1, 0), ks (Rj.V)^3 = 0.3 * 0.512.
    check_color(seen(whitted_floor()), Rgb(0.5 + 0.1536, 0.25 + 0.1536, 0.1536));
}

TEST_CASE("lights add up, each by its own angle", "[reference_002]")
{
    // The second: N.L = 0.8, Rj.V = (-0.6, 0.8, 0).(-0.6, 0.8, 0) = 1.
    Scene scene = whitted_floor();
    scene.lights.push_back(directional({3, 4, 0}, 0.5));
    const double second = 0.5 * 0.4 * 0.8;
    check_color(seen(scene), Rgb(0.6536 + second + 0.15, 0.4036 + second / 2 + 0.15, 0.3036));
}

TEST_CASE("R comes in with ks, T with kt, both white", "[reference_002]")
{
    Scene scene = whitted_floor();
    scene.background = Rgb(0, 1, 0);
    check_color(seen(scene), Rgb(0.6536, 0.4036 + 0.3, 0.1536));
    // Without refraction the transmitted ray continues to a floor below, which has ambient light.
    auto& model = std::get<WhittedMaterial>(scene.objects[0].material.model);
    model.transmissive = Rgb(0.5);
    WhittedMaterial glowing{.ambient = Rgb(1)};
    scene.objects.push_back(plane({0, -1, 0}, {0, 1, 0}, shaded(glowing, Rgb(0, 0, 1))));
    check_color(seen(scene), Rgb(0.6536, 0.7036, 0.1536 + 0.5 * 0.2));
}

TEST_CASE("at the end of the ray tree R and T do not count", "[reference_002]")
{
    Scene scene = whitted_floor();
    scene.background = Rgb(0, 1, 0);
    scene.max_depth = 0;
    check_color(seen(scene), Rgb(0.6536, 0.4036, 0.1536));
}

TEST_CASE("a transparent occluder scales the light by its transparency", "[reference_002]")
{
    Scene scene = whitted_floor();
    scene.objects.push_back(sphere({0, 2, 0}, 0.25, shaded(clear(Rgb(0.5, 0.25, 1)))));
    // Opaque shadows: only Ia is left.
    check_color(seen(scene), Rgb(0.1, 0.05, 0));
    // The ray enters and leaves the occluder, which counts once.
    scene.shadows = ShadowKind::transparent;
    check_color(seen(scene), Rgb(0.1 + 0.5 * 0.5536, 0.05 + 0.25 * 0.3536, 0.1536));
    // Two occluders multiply.
    scene.objects.push_back(sphere({0, 3, 0}, 0.25, shaded(clear(Rgb(0.1)))));
    check_color(seen(scene), Rgb(0.1 + 0.05 * 0.5536, 0.05 + 0.025 * 0.3536, 0.01536));
    // An occluder beyond the light does not count; an opaque one ends the ray.
    scene.objects.push_back(sphere({0, 5, 0}, 0.25, shaded(WhittedMaterial{})));
    check_color(seen(scene), Rgb(0.1 + 0.05 * 0.5536, 0.05 + 0.025 * 0.3536, 0.01536));
    scene.objects.push_back(sphere({0, 1, 0}, 0.25, shaded(WhittedMaterial{})));
    check_color(seen(scene), Rgb(0.1, 0.05, 0));
    scene.shadows = ShadowKind::none;
    check_color(seen(scene), Rgb(0.6536, 0.4036, 0.1536));
}

TEST_CASE("the normal faces the viewer from below too", "[reference_002]")
{
    // The light above does not count from this side; one below has the same effect as the light
    // above had.
    Scene scene = whitted_floor();
    const V org(-3, -4, 0);
    const V dir(3, 4, 0);
    check_color(trace(scene, org, dir), Rgb(0.1, 0.05, 0));
    scene.lights[1] = point_light({0, -4, 0}, 1);
    check_color(trace(scene, org, dir), Rgb(0.6536, 0.4036, 0.1536));
}

}  // namespace packtrace::test
