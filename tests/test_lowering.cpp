#include "catch.hpp"
#include "lower/packed_scene.hpp"
#include "lower/packed_tree.hpp"
#include "lower/prune.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"
#include <packtrace/build.hpp>
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/renderer.hpp>

#include <glm/geometric.hpp>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>

// Large scenes are lowered in chunks of objects, several chunks at once.
namespace packtrace {
namespace {

/// More objects than one chunk, of every kind; `kind_of` gives the kind.
constexpr int object_count = 70'000;

enum class Kind { sphere, plane, checkered, capped };

Kind kind_of(int number)
{
    return number % 97 == 5   ? Kind::plane
           : number % 89 == 7 ? Kind::checkered
           : number % 83 == 9 ? Kind::capped
                              : Kind::sphere;
}

Rgb color_of(int number)
{
    return {0.25 * (number % 3), 0.125 * (number % 7), number % 5 == 0 ? number * 1e-6 : 0.5};
}

Quadric capped_cylinder()
{
    return {.kind = QuadricKind::cylinder,
            .coefficients = {1, 1, 0, 0, 0, 0, 0, 0, 0, -1},
            .z_range = ZRange{-1.0, 1.0},
            .capped = true};
}

Surface surface_of(int number)
{
    switch (kind_of(number)) {
        case Kind::sphere:
            return Sphere{Vec3(number, 0.5, 3.0), 0.25};
        case Kind::capped:
            return capped_cylinder();
        default:
            return Plane{};
    }
}

Scene many_objects()
{
    Scene scene;
    for (int number = 0; number < object_count; ++number) {
        Object& object = scene.objects.emplace_back();
        object.name = "object " + std::to_string(number);
        object.surface = surface_of(number);
        object.material.color = color_of(number);
        if (kind_of(number) == Kind::checkered)
            object.material.checker = Checker{Rgb(number * 1e-6), 1.0 + number};
    }
    return scene;
}

LoweredScene lower_on(int threads, const Scene& scene)
{
    tbb::task_arena arena(threads);
    return arena.execute([&] { return lower(scene); });
}

template <class Elements>
bool same_bytes(const Elements& a, const Elements& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

template <class Object>
std::vector<std::int32_t> surfaces_of(const std::vector<Object>& objects)
{
    std::vector<std::int32_t> surfaces;
    for (const Object& object : objects)
        surfaces.push_back(object.surface);
    return surfaces;
}

}  // namespace

TEST_CASE("every surface of a large scene has its own object's material", "[lowering]")
{
    const Scene scene = many_objects();
    const LoweredScene lowered = lower(scene);
    std::size_t surface = 0;
    int wrong = 0;
    for (int number = 0; number < object_count; ++number) {
        const Kind kind = kind_of(number);
        for (int piece = 0; piece < (kind == Kind::capped ? 3 : 1); ++piece, ++surface) {
            const abi::MaterialIndex index = lowered.material_index.at(surface);
            const auto first = static_cast<std::size_t>(index.first);
            wrong += index.object != number;
            wrong += lowered.materials.at(first).diffuse != color_of(number);
            wrong += (index.checker >= 0) != (kind == Kind::checkered);
            if (index.checker < 0)
                continue;
            const auto checker = static_cast<std::size_t>(index.checker);
            wrong += lowered.materials.at(first + 1).diffuse != Rgb(number * 1e-6);
            wrong += lowered.checkers.at(checker).u.x != 1.0 / (1.0 + number);
        }
    }
    CHECK(wrong == 0);
    CHECK(surface == lowered.material_index.size());
    CHECK(lowered.faces_viewer.size() == surface);
}

TEST_CASE("surfaces are numbered in the order of objects, whatever their kinds", "[lowering]")
{
    const LoweredScene lowered = lower(many_objects());
    std::vector<std::int32_t> spheres, planes, quadrics;
    std::int32_t surface = 0;
    for (int number = 0; number < object_count; ++number) {
        const Kind kind = kind_of(number);
        (kind == Kind::sphere   ? spheres
         : kind == Kind::capped ? quadrics
                                : planes)
            .push_back(surface);
        surface += kind == Kind::capped ? 3 : 1;
    }
    CHECK(surfaces_of(lowered.spheres) == spheres);
    CHECK(surfaces_of(lowered.planes) == planes);
    CHECK(surfaces_of(lowered.quadrics) == quadrics);
    CHECK(lowered.spheres.back().center.x ==
          lowered.material_index[static_cast<std::size_t>(spheres.back())].object);
}

TEST_CASE("a lowered scene does not depend on the number of threads", "[lowering]")
{
    const Scene scene = many_objects();
    const LoweredScene one = lower_on(1, scene);
    const LoweredScene two = lower_on(2, scene);
    CHECK(same_bytes(one.material_index, two.material_index));
    CHECK(same_bytes(one.materials, two.materials));
    CHECK(same_bytes(one.checkers, two.checkers));
    CHECK(same_bytes(one.faces_viewer, two.faces_viewer));
    CHECK(surfaces_of(one.spheres) == surfaces_of(two.spheres));
}

TEST_CASE("of several objects without a surface the first is reported", "[lowering]")
{
    Scene scene = many_objects();
    for (const std::size_t number : {69'000u, 30'000u, 29'000u, 20'000u}) {
        scene.objects[number].surface = Quadric{.coefficients = {1, 1, 1, 0, 0, 0, 0, 0, 0, 1}};
    }
    CHECK_THROWS_WITH(lower(scene), test::ContainsSubstring("'object 20000'"));
}

TEST_CASE("objects with one material share its record", "[lowering]")
{
    const LoweredScene lowered = lower(generate_random_spheres({.count = 10'000}));
    CHECK(lowered.materials.size() == 1);
}

TEST_CASE("a sphere among many takes a hundred bytes at most", "[lowering][bulk]")
{
    constexpr int count = 50'000;
    for (const double radius : {0.001, 0.01})
        for (const Accuracy accuracy : {Accuracy::fast, Accuracy::exact}) {
            const RenderOptions options{.accuracy = accuracy};
            Scene scene = generate_random_spheres({.count = count, .radius = radius});
            // Too few pixels for light buffers of the spheres.
            test::set_size(scene, 64, 64);
            const Renderer<float> renderer(scene, options);
            INFO("radius " << radius);
            CHECK(static_cast<double>(renderer.scene_bytes()) / count < 100.0);
            CHECK(static_cast<double>(renderer.scene_bytes()) / count > 50.0);
        }
}

TEST_CASE("a light buffer of many spheres takes a few hundred bytes per sphere", "[lowering]")
{
    constexpr int count = 50'000;
    for (const double radius : {0.001, 0.01}) {
        Scene scene =
            generate_random_spheres({.count = count, .radius = radius, .reflective = 0.3});
        test::set_size(scene, 64, 64);
        const std::size_t few = Renderer<float>(scene, {}).scene_bytes();
        test::set_size(scene, 1024, 1024);
        const std::size_t many = Renderer<float>(scene, {}).scene_bytes();
        CHECK(many > few);
        CHECK(static_cast<double>(many - few) / count < 200.0);
    }
}

/// A picture of `count` objects: 900 spheres, a plane, and spheres that coincide with the first
/// hundred.
template <class Real>
Image<Real> picture_of(std::size_t count, const RenderOptions& options)
{
    Scene scene = generate_random_spheres({.count = 900, .radius = 0.05, .reflective = 0.4});
    scene.width = scene.height = 64;
    Object& floor = scene.objects.emplace_back(scene.objects.front());
    floor.surface = Plane{Vec3(0.0, -0.1, 0.0)};
    while (scene.objects.size() < count + 1)
        scene.objects.push_back(scene.objects[scene.objects.size() % 100]);
    Image<Real> image;
    Renderer<Real>(scene, options).render(image);
    return image;
}

TEMPLATE_TEST_CASE("many spheres give the picture of few, bit for bit", "[lowering]", float, double)
{
    for (const Accuracy accuracy : {Accuracy::fast, Accuracy::exact})
        for (const SelfHits self_hits : {SelfHits::note, SelfHits::exact}) {
            const RenderOptions options{.accuracy = accuracy, .self_hits = self_hits};
            const auto few = picture_of<TestType>(1000, options);
            const auto many = picture_of<TestType>(1100, options);
            CHECK(test::same_bits(few, many));
            CHECK(*std::max_element(few.rgb.begin(), few.rgb.end()) > TestType(0.1));
        }
}

TEST_CASE("a large sphere is anchored if its surface passes close to the origin for its size",
          "[lowering]")
{
    Scene scene;
    const auto add = [&](const Vec3& center, double radius) {
        scene.objects.emplace_back().surface = Sphere{center, radius};
    };
    add({0.0, -3000.0, 0.0}, 3000.0);  // passes through the origin
    add({0.0, 4.0, 0.0}, 4.0);         // a ball that touches the origin, too small to anchor
    add({0.0, -5001.0, 0.0}, 5000.0);
    add({3.0, 0.0, 4.0}, 1e6);      // contains the origin off its centre
    add({0.0, 0.0, 200.0}, 100.0);  // large, but as far away
    add({0.0, 65.2, 0.0}, 64.2);    // radius just above 64 times the distance from the origin
    add({0.0, 64.8, 0.0}, 63.8);    // radius just below this
    add({0.0, 0.0, 0.0}, 5.0);      // its surface is a radius away
    add({0.0, 4.1, 0.0}, 4.1);      // just large enough
    const LoweredScene lowered = lower(scene);
    CHECK(surfaces_of(lowered.anchored_spheres) == std::vector<std::int32_t>{0, 2, 5, 8});
    CHECK(surfaces_of(lowered.spheres) == std::vector<std::int32_t>{1, 3, 4, 6, 7});
    for (const LoweredAnchoredSphere& sphere : lowered.anchored_spheres) {
        // The point of the surface closest to the origin.
        CHECK(glm::length(sphere.anchor - sphere.center) == Approx(sphere.radius));
        CHECK(glm::length(sphere.anchor) < sphere.radius / 64.0);
    }
}

TEST_CASE("a sphere that is turned and scaled stays a sphere, but a stretched one does not",
          "[lowering]")
{
    const Object ball = make_object(sphere({1, 2, 3}, 0.5));
    Object turned = ball;
    for (const double degrees : {10.0, 33.3, -77.0})
        turned = scale(rotate(turned, {1, 0.5, -0.7}, degrees), 1.7);
    Scene scene;
    scene.objects = {ball, turned, scale(ball, {-1, 1, 1}), scale(ball, {1, 1, 1 + 0x1p-41})};
    const LoweredScene lowered = lower(scene);
    CHECK(surfaces_of(lowered.spheres) == std::vector<std::int32_t>{0, 1, 2});
    CHECK(lowered.quadrics.size() == 1);
}

TEST_CASE("a tiny stretch of a sphere shows in its hits", "[lowering]")
{
    Scene scene;
    scene.objects = {scale(make_object(ellipsoid()), {1, 1, 1 + 0x1p-41})};
    const RayScene<double> traced(scene);
    CHECK(traced.closest_hit({.org = {0, 0, -3}, .dir = {0, 0, 1}}).t == 2 - 0x1p-41);
    CHECK(traced.closest_hit({.org = {0, -3, 0}, .dir = {0, 1, 0}}).t == 2);
}

TEST_CASE("one surface clipped at two places does not count as a duplicate", "[lowering]")
{
    // One unit sphere in two object spaces, with the origin at its centre or below it. Their clips
    // keep different parts.
    Quadric around_center{.coefficients = {1, 1, 1, 0, 0, 0, 0, 0, 0, -1},
                          .z_range = ZRange{0.0, 0.5}};
    Quadric from_below = around_center;
    from_below.coefficients = {1, 1, 1, 0, 0, 0, 0, 0, -2, 0};
    Scene scene;
    for (const Quadric& quadric : {around_center, from_below, around_center})
        scene.objects.emplace_back().surface = quadric;
    scene.objects[1].transform[3] = {0.0, 0.0, -1.0, 1.0};
    LoweredScene lowered = lower(scene);
    CHECK(remove_duplicates(lowered) == 1);
    CHECK(lowered.quadrics.size() == 2);
}

/// The objects of a scene that are anchored spheres.
std::vector<std::int32_t> anchored_objects(const Scene& scene)
{
    const LoweredScene lowered = lower(scene);
    std::vector<std::int32_t> objects;
    for (const std::int32_t surface : surfaces_of(lowered.anchored_spheres))
        objects.push_back(lowered.material_index.at(static_cast<std::size_t>(surface)).object);
    return objects;
}

TEST_CASE("a sphere is anchored independently of the rest of its scene", "[lowering]")
{
    Scene scene;
    const double radii[] = {3000.0, 1.0, 200.0, 0.5, 1e6};
    for (const double radius : radii)
        scene.objects.emplace_back().surface = Sphere{{0.0, -0.5 - radius, 0.1}, radius};
    const std::vector<std::int32_t> anchored{0, 2, 4};
    REQUIRE(anchored_objects(scene) == anchored);
    for (const double far : {1.0, 250.0, 1e5, 1e9}) {
        CAPTURE(far);
        Scene other = scene;
        other.camera.position = Vec3(0.0, far, -far);
        CHECK(anchored_objects(other) == anchored);
        other.lights.push_back({LightType::point, Rgb(0.001), {0.0, far, 0.0}});
        CHECK(anchored_objects(other) == anchored);
        other.objects.emplace_back().surface = Plane{{0.0, -far, 0.0}};
        other.objects.emplace_back().surface = Sphere{{far, 0.0, far}, 0.25 * far};
        other.objects.emplace_back().surface = capped_cylinder();
        CHECK(anchored_objects(other) == anchored);
    }
}

TEST_CASE("every child of a bvh node refers to an existing node or object", "[lowering]")
{
    for (const bool polygons : {false, true})
        for (const bool spheres : {false, true}) {
            CAPTURE(polygons, spheres);
            Scene scene;
            for (int i = 0; i < 141; ++i) {
                const Object other = polygons
                                         ? make_object(polygon({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}))
                                         : make_object(ellipsoid());
                const bool is_sphere = spheres && i % 3 == 0;
                scene.objects.push_back(translate(
                    is_sphere ? make_object(Sphere{}) : packtrace::scale(other, {1, 0.5, 1}),
                    {3.0 * (i % 12), 3.0 * (i / 12), 0.0}));
            }
            const PackedTree<float> tree(lower(scene));
            const abi::BvhView<float>& view = tree.view();
            const int in_runs = 141 - (spheres ? 47 : 0);
            REQUIRE(view.node_count > 1);
            for (int i = 0; i < view.node_count; ++i)
                for (const std::uint32_t child : view.nodes[i].child) {
                    if (!abi::is_leaf(child))
                        CHECK(static_cast<int>(child) < view.node_count);
                    else if (abi::is_run(child))
                        CHECK(abi::first_of_run(child) + abi::run_count(child) <= in_runs);
                    else
                        CHECK(static_cast<int>(child & abi::block_mask) < tree.block_count());
                }
        }
}

}  // namespace packtrace
