// Note 004 against numbers computed by hand from its algorithms.
#include "catch.hpp"
#include "reference/models/note_004.hpp"
#include "reference_scenes.hpp"

#include <cmath>
#include <vector>

namespace packtrace::test {
namespace {

using V = reference::Vec3<double>;
using Note = reference::Note004<double>;

Material reflecting(double r0, double r1, double r2, double r3, const Rgb& color = Rgb(1))
{
    return shaded(ShaderMaterial{{r0, r1, r2, r3}}, color);
}

Scene shader_scene(const std::vector<Object>& objects, const std::vector<Light>& lights)
{
    return {.illumination = Illumination::shader, .objects = objects, .lights = lights};
}

void scale(Object& object, double x, double y, double z)
{
    object.transform[0] *= x;
    object.transform[1] *= y;
    object.transform[2] *= z;
}

// The floor y = 0 hit at the origin with V = (-0.6, 0.8, 0) and the light straight above:
// Id = 1, R = (0, 1, 0), Is = 0.8.
Scene shader_floor(const Rgb& color = Rgb(1))
{
    return shader_scene({plane({0, 0, 0}, {0, 1, 0}, reflecting(0.1, 0.4, 0.5, 2, color))},
                        {point_light({0, 4, 0}, 1)});
}

}  // namespace

TEST_CASE("f is r0 + r1 Id + r2 Is^r3 times colour and light", "[reference_004]")
{
    check_color(seen(shader_floor()), Rgb(0.1 + 0.4 + 0.5 * 0.64));
    Scene scene = shader_floor(Rgb(1, 0.5, 0));
    scene.lights[0].intensity = Rgb(0.5, 1, 1);
    check_color(seen(scene), Rgb(0.41, 0.41, 0));
}

TEST_CASE("a highlight vanishes where R points away from V, for any exponent, in packets too",
          "[reference_004]")
{
    // The light is behind the viewer: Is = 0 for half of the surface that it lights.
    Scene scene = shader_scene({sphere({0, 0, 4}, 1, reflecting(0, 0, 1, 0))},
                               {directional({1, 0, 0.2}, 0.5)});
    scene.width = scene.height = 16;
    const Image<double> image = render<double>(scene, {.kernel = Kernel::scalar});
    CHECK(render<double>(scene).rgb == image.rgb);
    CHECK(std::count(image.rgb.begin(), image.rgb.end(), 0.5) > 30);
}

TEST_CASE("several lights add up, an ambient one gives r0", "[reference_004]")
{
    // Directional (3, 4, 0): Id = 0.8, R = (-0.6, 0.8, 0) = V, Is = 1.
    Scene scene = shader_floor();
    scene.lights.push_back(ambient(0.3));
    scene.lights.push_back(directional({3, 4, 0}, 0.5));
    check_color(seen(scene), Rgb(0.82 + 0.03 + 0.5 * (0.1 + 0.32 + 0.5)));
}

TEST_CASE("a shadowed point has r0 alone, times the light", "[reference_004]")
{
    Scene scene = shader_floor();
    scene.lights[0].intensity = Rgb(2);
    scene.objects.push_back(sphere({0, 2, 0}, 0.5, reflecting(0, 0, 0, 1)));
    check_color(seen(scene), Rgb(0.2));
    scene.shadows = ShadowKind::none;
    check_color(seen(scene), Rgb(1.64));
}

TEST_CASE("an object beyond the light casts no shadow", "[reference_004]")
{
    Scene scene = shader_floor();
    scene.objects.push_back(sphere({0, 6, 0}, 0.5, reflecting(0, 0, 0, 1)));
    check_color(seen(scene), Rgb(0.82));
    scene.lights = {directional({0, 1, 0}, 1)};
    check_color(seen(scene), Rgb(0.1));
}

TEST_CASE("each object gets the shadow ray from the world, whatever precedes the object",
          "[reference_004]")
{
    // In the listing, the occluder would get the ray in the previous object's space. That object is
    // far away and much larger.
    Scene scene = shader_floor();
    scene.objects.push_back(sphere({0, 0, 0}, 1, reflecting(0, 0, 0, 1)));
    scale(scene.objects[1], 10, 10, 10);
    scene.objects[1].transform[3] = {500, 0, 0, 1};
    scene.objects.push_back(sphere({0, 0, 0}, 1, reflecting(0, 0, 0, 1)));
    scale(scene.objects[2], 0.25, 0.25, 0.25);
    scene.objects[2].transform[3] = {0, 2, 0, 1};
    check_color(seen(scene), Rgb(0.1));
    scene.objects.pop_back();
    check_color(seen(scene), Rgb(0.82));
}

TEST_CASE("the side away from the light is in the object's own shadow", "[reference_004]")
{
    const Scene scene = shader_scene({sphere({0, 0, 0}, 1, reflecting(0.1, 0.4, 0.5, 2))},
                                     {point_light({0, 0, 9}, 1)});
    check_color(trace(scene, {0, 0, -5}, {0, 0, 1}), Rgb(0.1));
    check_color(trace(scene, {0, 0, 5}, {0, 0, -1}), Rgb(1));
}

TEST_CASE("the normal is the object's own and does not turn to the viewer", "[reference_004]")
{
    // From below, V = (-0.6, -0.8, 0), the floor's N still points up: Id = 1 and Is = 0.
    check_color(trace(shader_floor(), {-3, -4, 0}, {3, 4, 0}), Rgb(0.5));
}

TEST_CASE("minimumIntersection lists each object once, nearest first", "[reference_004]")
{
    Scene scene = shader_scene(
        {sphere({0, 0, 9}, 1, reflecting(0, 0, 0, 1)), sphere({0, 5, 0}, 1, reflecting(0, 0, 0, 1)),
         sphere({0, 0, 0}, 1, reflecting(0, 0, 0, 1)),
         plane({0, 0, 8}, {0, 0, 1}, reflecting(0, 0, 0, 1))},
        {});
    // Semi-axes 1, 1, 2 around z = 5.
    scale(scene.objects[2], 1, 1, 2);
    scene.objects[2].transform[3] = {0, 0, 5, 1};
    const reference::World<double> world(scene);
    std::vector<Note::Tuple> list;
    Note(scene, world).minimum_intersection({0, 0, 0}, {0, 0, 1}, list);
    REQUIRE(list.size() == 3);
    CHECK(list[0].k == 2);
    CHECK(list[0].t0 == 3);
    CHECK(list[1].k == 0);
    CHECK(list[1].t0 == 8);
    CHECK(list[2].k == 3);
    CHECK(list[2].t0 == 8);
}

TEST_CASE("under a similarity object space gives the world's colours", "[reference_004]")
{
    // The same sphere as surface and by matrix: three times as large, turned about z.
    const Material material = reflecting(0.1, 0.4, 0.5, 7);
    const std::vector<Light> lights = {point_light({4, 9, -6}, 1), directional({-1, 2, -3}, 1)};
    const Scene direct = shader_scene({sphere({1, 0, 0}, 3, material)}, lights);
    Scene placed = shader_scene({sphere({0, 0, 0}, 1, material)}, lights);
    placed.objects[0].transform = Mat4(1.8, 2.4, 0, 0, -2.4, 1.8, 0, 0, 0, 0, 3, 0, 1, 0, 0, 1);
    for (int i = -5; i <= 5; ++i) {
        const V dir(0.1 * i, 0.05 * i, 1);
        const V expected = trace(direct, {0.5, 0.2, -9}, dir);
        check_color(trace(placed, {0.5, 0.2, -9}, dir), Rgb(expected.x, expected.y, expected.z));
    }
}

TEST_CASE("under a non-uniform scale object space gives other angles than the world",
          "[reference_004]")
{
    // The floor stretched by 2 in y and a light at (4, 4, 0), which is (4, 2, 0) in object space.
    // There Id = 2/sqrt(20); in the world it would be 1/sqrt(2).
    Scene scene = shader_scene({plane({0, 0, 0}, {0, 1, 0}, reflecting(0, 1, 0, 1))},
                               {point_light({4, 4, 0}, 1)});
    check_color(seen(scene), Rgb(1 / std::sqrt(2.0)));
    scale(scene.objects[0], 1, 2, 1);
    check_color(seen(scene), Rgb(2 / std::sqrt(20.0)));
}

}  // namespace packtrace::test
