#include "catch.hpp"
#include "lower/buffered_scene.hpp"
#include "render_scene.hpp"
#include "scenes.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>
#include <packtrace/renderer.hpp>

#include <cmath>
#include <random>

// A light buffer of the spheres in a bvh gives the same shadows as lists, bit for bit.
namespace packtrace::test {
namespace {

/// Spheres of radius 0.01 to 1 around (0, 0, 6), some inside each other, over a ground.
Scene crowd(int count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    Scene scene;
    set_size(scene, 120, 90);
    const Material material = scratch(Rgb(0.5), 50, 0.3);
    for (int i = 0; i < count; ++i) {
        const double x = 3.0 * unit(random);
        const double y = 3.0 * unit(random);
        const double z = 6.0 + 3.0 * unit(random);
        add_sphere(scene, {x, y, z}, std::pow(10.0, -1.0 + unit(random)), material);
    }
    add_sphere(scene, {0, -5004, 0}, 5000, material);
    return scene;
}

void light_from(Scene& scene, const Vec3& position)
{
    scene.lights = {Light{.type = LightType::point, .intensity = Rgb(0.6), .vector = position}};
}

void light_along(Scene& scene, const Vec3& direction)
{
    scene.lights = {
        Light{.type = LightType::directional, .intensity = Rgb(0.6), .vector = direction}};
}

/// Whether the scene's only light has a buffer.
bool has_buffer(const Scene& scene)
{
    const LoweredScene lowered = lower(scene);
    const PackedScene<float> packed(lowered, Traversal::tree);
    if (static_cast<double>(scene.width) * scene.height <
        camera_rays_for_buffers(packed, lowered.bounces))
        return false;
    const BufferedScene<float> buffered(packed);
    const abi::SceneView<float>* const casters = buffered.view().casters;
    return (casters != nullptr ? *casters : buffered.view()).lighting.buffers[0].cells != nullptr;
}

void check_against_lists(const Scene& scene, SelfHits self_hits)
{
    for (const std::string& isa : supported_isas()) {
        INFO(isa);
        RenderOptions options{.isa = isa, .self_hits = self_hits, .traversal = Traversal::list};
        const Image<float> by_lists = render<float>(scene, options);
        options.traversal = Traversal::tree;
        const Image<float> by_buffer = render<float>(scene, options);
        CHECK(by_lists.rgb == by_buffer.rgb);
    }
}

}  // namespace

TEST_CASE("A light buffer of many spheres gives the shadows of lists", "[light_buffer]")
{
    const Vec3 positions[] = {{9, 12, -7}, {0, 30, 6}, {0, 0, -3}, {60, 100, -70}};
    for (const Vec3& position : positions)
        for (const SelfHits self_hits : {SelfHits::exact, SelfHits::note}) {
            INFO(position.x << ' ' << position.y << ' ' << position.z);
            Scene scene = crowd(400, 7);
            light_from(scene, position);
            REQUIRE(has_buffer(scene));
            check_against_lists(scene, self_hits);
        }
}

TEST_CASE("A parallel light's buffer of many spheres gives the shadows of lists", "[light_buffer]")
{
    const Vec3 directions[] = {{1, 2, -1}, {0, 1, 0}, {-3e5, 1e5, 2e5}, {1, 0.02, -0.3}};
    for (const Vec3& direction : directions)
        for (const SelfHits self_hits : {SelfHits::exact, SelfHits::note}) {
            INFO(direction.x << ' ' << direction.y << ' ' << direction.z);
            Scene scene = crowd(400, 11);
            light_along(scene, direction);
            REQUIRE(has_buffer(scene));
            check_against_lists(scene, self_hits);
        }
}

TEST_CASE("Parallel light reaches objects far behind the spheres in its buffer", "[light_buffer]")
{
    // A wall so far away that rounding there is as large as a cell of the buffer.
    Scene scene = crowd(400, 12);
    scene.camera.fov = 3.0;
    scene.camera.position = {0, 0, -60};
    scene.camera.rotation = Mat3(1.0);
    add_sphere(scene, {0, 0, 3000000}, 2000000, scratch(Rgb(0.5), 50, 0));
    light_along(scene, {0.001, 0.0005, -1});
    REQUIRE(has_buffer(scene));
    check_against_lists(scene, SelfHits::exact);
}

TEST_CASE("A light buffer skips objects that cast no shadow", "[light_buffer]")
{
    Scene scene = crowd(400, 8);
    light_from(scene, {9, 12, -7});
    for (std::size_t i = 0; i < scene.objects.size(); i += 3)
        scene.objects[i].casts_shadow = false;
    REQUIRE(has_buffer(scene));
    check_against_lists(scene, SelfHits::exact);
}

TEST_CASE("A light among the spheres has no buffer, and neither has a frame with few rays",
          "[light_buffer]")
{
    Scene scene = crowd(400, 9);
    light_from(scene, {0.3, 0.4, 6});
    CHECK_FALSE(has_buffer(scene));
    check_against_lists(scene, SelfHits::exact);

    light_from(scene, {9, 12, -7});
    CHECK(has_buffer(scene));
    set_size(scene, 16, 16);
    CHECK_FALSE(has_buffer(scene));
}

TEST_CASE("Spheres inside each other have no light buffer, which would be larger than they are",
          "[light_buffer]")
{
    Scene scene = crowd(1000, 11);
    set_size(scene, 160, 120);
    light_from(scene, {20, 30, -15});
    REQUIRE(has_buffer(scene));
    for (Object& object : scene.objects)
        std::get<Sphere>(object.surface).radius = 8;
    CHECK_FALSE(has_buffer(scene));
    light_along(scene, {1, 2, 3});
    CHECK_FALSE(has_buffer(scene));
    check_against_lists(scene, SelfHits::exact);

    // One sphere of this size hides the others, and the buffer stays small.
    scene = crowd(1000, 11);
    set_size(scene, 160, 120);
    light_from(scene, {20, 30, -15});
    std::get<Sphere>(scene.objects[0].surface).radius = 8;
    CHECK(has_buffer(scene));
}

TEST_CASE("Lights get buffers with the frame that pays for them, and frames stay the same",
          "[light_buffer]")
{
    Scene scene = crowd(400, 10);
    light_from(scene, {9, 12, -7});
    set_size(scene, 48, 32);
    REQUIRE_FALSE(has_buffer(scene));
    const Renderer<float> renderer(scene, {.traversal = Traversal::tree});
    Image<float> first;
    renderer.render(first);
    const std::size_t bytes = renderer.scene_bytes();
    Image<float> later;
    int frames = 1;
    for (; frames < 20 && renderer.scene_bytes() == bytes; ++frames) {
        renderer.render(later);
        CHECK(later.rgb == first.rgb);
    }
    CHECK(frames > 2);
    CHECK(renderer.scene_bytes() > bytes);
    renderer.render(later);
    CHECK(later.rgb == first.rgb);
}

TEST_CASE("Spheres side by side, and a sphere that hides others, have the shadows of lists",
          "[light_buffer]")
{
    Scene scene = generate_sphereflake({.depth = 3, .reflective = 0.3});
    set_size(scene, 200, 160);
    light_from(scene, {4, 3, 2});
    REQUIRE(has_buffer(scene));
    check_against_lists(scene, SelfHits::exact);
    light_along(scene, {4, 3, -2});
    REQUIRE(has_buffer(scene));
    check_against_lists(scene, SelfHits::exact);
}

}  // namespace packtrace::test
