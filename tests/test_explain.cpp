// Ray trees of single pixels: packets against the reference, and both against the pictures.
#include "dispatch/kernels.hpp"
#include "explain_trees.hpp"
#include "render_scene.hpp"
#include "scene_files.hpp"
#include <packtrace/explain.hpp>

#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace packtrace::test {
namespace {

constexpr int columns = 6;
constexpr int rows = 5;

int spread(int i, int count, int size)
{
    return (2 * i + 1) * size / (2 * count);
}

double distance(const Rgb& color, const double* pixel)
{
    return glm::length(color - Rgb(pixel[0], pixel[1], pixel[2]));
}

bool is_partial(const Rgb& share)
{
    return share.x > 0.0 && share.x < 1.0;
}

/// Adds names of the kinds of content that a tree holds at one of its rays.
void add_contents(const RayNode& ray, std::set<std::string>& found)
{
    const char* const kinds[] = {"camera", "mirrored", "refracted"};
    found.insert(std::string(kinds[static_cast<int>(ray.kind)]) +
                 (ray.object < 0 ? " miss" : " hit"));
    for (const LightShare& light : ray.lights)
        if (!light.share)
            found.insert("a light from behind");
        else if (is_partial(*light.share))
            found.insert("a partial share");
        else
            found.insert(light.share->x > 0.0 ? "a light" : "a shadow");
    if (ray.object >= 0 && ray.brought != Rgb(0.0))
        found.insert("a depth limit");
}

/// Compares both trees of some pixels with each other and with both pictures. Returns the kinds of
/// content in the packets' trees.
std::set<std::string> check_pixels(const Scene& scene)
{
    const Image<double> scalar = render_scalar<double>(scene);
    std::vector<Image<double>> packets;
    for (const std::string& isa : supported_isas())
        packets.push_back(render_packets<double>(scene, isa));
    std::set<std::string> found;
    for (int i = 0; i < columns * rows; ++i) {
        const int x = spread(i % columns, columns, scene.width);
        const int y = spread(i / columns, rows, scene.height);
        const RayNode reference = reference_tree(scene, x, y);
        CAPTURE(x, y);
        CHECK(distance(sum_of(reference), scalar.pixel(x, y)) <= 1e-9);
        for (std::size_t k = 0; k < packets.size(); ++k) {
            const std::string isa = supported_isas()[k];
            CAPTURE(isa);
            const RayNode tree = packet_tree<double>(scene, x, y, isa);
            CHECK(first_difference(reference, tree) == "none");
            CHECK(distance(sum_of(tree), packets[k].pixel(x, y)) <= 1e-9);
            visit_tree(tree, [&found](const RayNode& ray) { add_contents(ray, found); });
        }
    }
    return found;
}

/// Whitted's model, where the depth limit does not change a hit's own colour: a mirror in front of
/// a ball that only the mirror shows.
Scene mirror_and_ball()
{
    Scene scene;
    set_size(scene, 21, 21);
    scene.illumination = Illumination::whitted;
    scene.background = {0.1, 0.2, 0.3};
    Material mirror;
    mirror.model = WhittedMaterial{Rgb(0.1), Rgb(0.3), Rgb(0.5), Rgb(0.0), 20.0, 1.0};
    add_plane(scene, {0, 0, 5}, {0, 0, -1}, mirror);
    Material matte;
    matte.model = WhittedMaterial{Rgb(0.1), Rgb(0.9), Rgb(0.0), Rgb(0.0), 20.0, 1.0};
    add_sphere(scene, {0, 0, -4}, 2, matte);
    scene.lights = note_lights();
    return scene;
}

/// The first difference between the middle pixel's trees of mirror_and_ball() and of the scene
/// after `change`.
std::string planted(const std::function<void(Scene&)>& change,
                    double tolerance = double_tree_tolerance)
{
    Scene scene = mirror_and_ball();
    const RayNode reference = reference_tree(scene, 10, 10);
    change(scene);
    return first_difference(reference, packet_tree<double>(scene, 10, 10), tolerance);
}

}  // namespace

TEST_CASE(
    "trees of double packets are the reference's, add up to both pictures, and hold every kind "
    "of ray, light and end",
    "[explain]")
{
    std::set<Illumination> models;
    std::set<std::string> found;
    for (const auto& file : scene_files()) {
        const Scene scene = small_or_deep_scene(file);
        models.insert(scene.illumination);
        CAPTURE(file.filename().string());
        found.merge(check_pixels(scene));
    }
    CHECK(models.size() == 5);
    CHECK(found == std::set<std::string>{"camera hit", "camera miss", "mirrored hit",
                                         "mirrored miss", "refracted hit", "refracted miss",
                                         "a light from behind", "a partial share", "a light",
                                         "a shadow", "a depth limit"});
}

TEST_CASE("trees of float packets add up to the picture of floats", "[explain]")
{
    for (const auto& file : scene_files()) {
        const Scene scene = small_or_deep_scene(file);
        const int y = scene.height / 2;
        for (const std::string& isa : supported_isas()) {
            const auto picture = convert<double>(render_packets<float>(scene, isa));
            for (int x = 3; x < scene.width; x += scene.width / 6) {
                CAPTURE(file.filename().string(), isa, x);
                const RayNode tree = packet_tree<float>(scene, x, y, isa);
                CHECK(distance(sum_of(tree), picture.pixel(x, y)) <= 2e-5);
            }
        }
    }
}

TEST_CASE("the pixels of an empty scene are camera rays that miss", "[explain]")
{
    Scene scene;
    set_size(scene, 19, 3);
    scene.background = {0.25, 0.5, 0.75};
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        const RayNode tree = packet_tree<float>(scene, 18, 2, isa);
        CHECK(tree.object == -1);
        CHECK(std::isinf(tree.t));
        CHECK((tree.brought == scene.background));
        CHECK(first_difference(reference_tree(scene, 18, 2), tree, single_tree_tolerance) ==
              "none");
    }
}

TEST_CASE("a planted difference is found at its ray", "[explain]")
{
    CHECK(planted([](Scene&) {}) == "none");
    const auto nudge = [](Scene& s) { std::get<Sphere>(s.objects[1].surface).radius += 1e-7; };
    CHECK(planted(nudge) == "camera, mirrored: t");
    CHECK(planted(nudge, single_tree_tolerance) == "none");
    CHECK(planted([](Scene& s) {
              s.objects[1].material.color = {1.0, 1.0, 0.9};
          }) == "camera, mirrored: light 2 color");
    CHECK(planted([](Scene& s) { s.lights[0].intensity *= 1.1; }) == "camera: local");
    CHECK(planted([](Scene& s) { s.background = {0.1, 0.2, 0.4}; }) == "none");
    CHECK(planted([](Scene& s) { s.camera.position.x += 1e-3; }) == "camera: origin");
    const auto dull = [](Scene& s) {
        std::get<WhittedMaterial>(s.objects[0].material.model).specular = Rgb(0.4);
    };
    CHECK(planted(dull) == "camera: light 2 color");
    const auto dull_and_dark = [&](Scene& s) {
        dull(s);
        s.lights.clear();
    };
    CHECK(planted(dull_and_dark, 0.9) == "camera: light 2 share");
}

TEST_CASE("another object and a missing ray always differ", "[explain]")
{
    const double lenient = 1e9;
    CHECK(planted([](Scene& s) { s.objects.pop_back(); }, lenient) == "camera, mirrored: object");
    CHECK(planted([](Scene& s) { s.max_depth = 0; }, lenient) == "camera, mirrored: origin");
}

TEST_CASE("NaN differs from everything, infinity from every number", "[explain]")
{
    RayNode tree;
    CHECK(first_difference(tree, tree) == "none");
    RayNode other = tree;
    other.t = 1e300;
    CHECK(first_difference(tree, other) == "camera: t");
    other = tree;
    other.weight.y = std::numeric_limits<double>::quiet_NaN();
    CHECK(first_difference(tree, other) == "camera: weight");
    CHECK(first_difference(other, other) == "camera: weight");
}

TEST_CASE("a share that only one tree computed is no difference, a different share is one",
          "[explain]")
{
    RayNode tree;
    tree.object = 0;
    tree.lights = {{1, Rgb(1.0), Rgb(0.0)}};
    RayNode other = tree;
    other.lights[0].share.reset();
    CHECK(first_difference(tree, other) == "none");
    other.lights[0].share = Rgb(0.0);
    CHECK(first_difference(tree, other) == "camera: light 2 share");
    other.lights.clear();
    CHECK(first_difference(tree, other) == "camera: light 2 share");
}

TEST_CASE("trees too deep for a path's number are refused", "[explain]")
{
    Scene scene = mirror_and_ball();
    scene.max_depth = 28;
    CHECK_NOTHROW(packet_tree<float>(scene, 10, 10));
    scene.max_depth = 29;
    CHECK_THROWS_WITH(packet_tree<float>(scene, 10, 10), ContainsSubstring("max_depth is 29"));
    scene.max_depth = 60;
    CHECK_NOTHROW(packet_tree<double>(scene, 10, 10));
    scene.max_depth = 61;
    CHECK_THROWS_WITH(packet_tree<double>(scene, 10, 10), ContainsSubstring("down to 60"));
    CHECK_NOTHROW(reference_tree(scene, 10, 10));
}

TEST_CASE("a path of 28 bounces in floats keeps its number", "[explain]")
{
    // Between two mirrors that face each other.
    Scene scene = mirror_and_ball();
    scene.objects.pop_back();
    add_plane(scene, {0, 0, -5}, {0, 0, 1}, scene.objects[0].material);
    scene.max_depth = 28;
    int rays = 0;
    visit_tree(packet_tree<float>(scene, 10, 10), [&](const RayNode&) { ++rays; });
    CHECK(rays == 29);
}

TEST_CASE("a scene gets the kernels with a probe only if it asks for them", "[explain]")
{
    for (const abi::KernelTable* table : all_kernels())
        for (const bool quadrics : {false, true})
            for (const bool glass : {false, true}) {
                const abi::Features needed{.quadrics = quadrics, .glass = glass};
                abi::Features probed = needed;
                probed.probe = true;
                const auto& floats = table->single_precision;
                for (const bool exact : {false, true}) {
                    const auto& usual = kernels_for(floats, abi::with_exact(needed, exact));
                    CHECK_FALSE(usual.set.features.probe);
                    CHECK(usual.set.features.exact == exact);
                    const auto& probe = kernels_for(floats, abi::with_exact(probed, exact));
                    CHECK(probe.set.features.probe);
                    CHECK(probe.set.features.exact == exact);
                }
                CHECK_FALSE(kernels_for(table->double_precision, needed).set.features.probe);
            }
}

TEST_CASE("a pixel outside the picture is refused", "[explain]")
{
    const Scene scene = mirror_and_ball();
    for (const auto& [x, y] :
         {std::pair(-1, 0), std::pair(0, -1), std::pair(21, 0), std::pair(0, 21)})
        CHECK_THROWS_WITH(reference_tree(scene, x, y),
                          ContainsSubstring("outside the picture of 21 x 21"));
    CHECK_NOTHROW(packet_tree<float>(scene, 20, 20));
}

}  // namespace packtrace::test
