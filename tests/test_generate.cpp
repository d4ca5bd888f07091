#include "catch.hpp"
#include "refusal.hpp"
#include "run_program.hpp"
#include "scene_text.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/write_scene.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

// Procedural scenes, and scenes as text.
namespace packtrace {
namespace {

using test::ContainsSubstring;
using test::read_text;
using test::refusal;
using test::run_packtrace;
using test::TempFolder;

const Sphere& sphere(const Scene& scene, std::size_t i)
{
    return std::get<Sphere>(scene.objects.at(i).surface);
}

/// Writes a scene, reads it and writes it again. The writer keeps every field, so equal texts mean
/// equal scenes.
void check_round_trip(const Scene& scene)
{
    const std::string text = scene_text(scene);
    const Scene read = test::parse(text);
    CHECK(scene_text(read) == text);
    REQUIRE(read.objects.size() == scene.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        if (read.objects[i].name != scene.objects[i].name)
            FAIL("object " << i << " is named " << read.objects[i].name);
}

/// Checks the children of `parent` among its `size` descendants, which follow it, and counts them.
std::size_t check_children(const Scene& scene, std::size_t parent, std::size_t size)
{
    const Sphere& own = sphere(scene, parent);
    const std::size_t child_size = (size - 1) / 9;
    for (std::size_t child = parent + 1; child < parent + size; child += child_size) {
        const Sphere& other = sphere(scene, child);
        CHECK(other.radius == Approx(own.radius / 3.0).epsilon(1e-14));
        CHECK(glm::distance(own.center, other.center) ==
              Approx(own.radius + other.radius).epsilon(1e-12));
        if (child_size > 1)
            check_children(scene, child, child_size);
    }
    return child_size;
}

}  // namespace

TEST_CASE("each sphere of a sphereflake has nine children", "[generate]")
{
    std::size_t count = 1;
    for (int depth = 0; depth <= 4; ++depth) {
        CHECK(generate_sphereflake({.depth = depth}).objects.size() == count);
        count = 9 * count + 1;
    }
    CHECK(generate_sphereflake({.depth = 4}).objects.size() == 7381);
}

TEST_CASE("a sphereflake of depth 6 has 597871 spheres", "[generate][slow]")
{
    CHECK(generate_sphereflake({.depth = 6}).objects.size() == 597871);
}

TEST_CASE("a sphereflake's spheres touch their parents", "[generate]")
{
    const Scene scene = generate_sphereflake({.depth = 3});
    CHECK(sphere(scene, 0).radius == 0.5);
    CHECK(check_children(scene, 0, scene.objects.size()) == 91);
}

TEST_CASE("a sphere's nine children are apart, and none is where the sphere touches its parent",
          "[generate]")
{
    const Scene scene = generate_sphereflake({.depth = 1});
    for (std::size_t i = 1; i < 10; ++i) {
        CHECK(sphere(scene, i).center.z > -1e-12);
        for (std::size_t j = 1; j < i; ++j)
            CHECK(glm::distance(sphere(scene, i).center, sphere(scene, j).center) >
                  0.99 * (0.5 + 1.0 / 6.0));
    }
}

TEST_CASE("an option adds ground and lamps to a sphereflake", "[generate]")
{
    const Scene bare = generate_sphereflake({.depth = 2, .reflective = 0.5});
    const Scene full = generate_sphereflake({.depth = 2, .reflective = 0.5, .ground = true});
    CHECK(bare.lights.size() == 2);
    CHECK(full.lights.size() == 4);
    REQUIRE(full.objects.size() == bare.objects.size() + 1);
    CHECK(std::get<Plane>(full.objects.back().surface).point.z == -0.5);
    CHECK(std::get<ScratchMaterial>(full.objects[0].material.model).reflective == 0.5);
}

TEST_CASE("random spheres fill the unit cube evenly, and a seed repeats them", "[generate]")
{
    const Scene scene = generate_random_spheres({.count = 8000, .radius = 0.01, .seed = 3});
    REQUIRE(scene.objects.size() == 8000);
    std::vector<int> octants(8);
    for (std::size_t i = 0; i < 8000; ++i) {
        const Vec3 c = sphere(scene, i).center;
        REQUIRE(glm::all(glm::greaterThanEqual(c, Vec3(0.0))));
        REQUIRE(glm::all(glm::lessThan(c, Vec3(1.0))));
        ++octants[static_cast<std::size_t>((c.x < 0.5) + 2 * (c.y < 0.5) + 4 * (c.z < 0.5))];
    }
    // Six standard deviations.
    for (const int count : octants)
        CHECK(std::abs(count - 1000) < 180);
    const auto again = generate_random_spheres({.count = 8000, .radius = 0.01, .seed = 3});
    CHECK(scene_text(again) == scene_text(scene));
    const auto other = generate_random_spheres({.count = 8000, .radius = 0.01, .seed = 4});
    CHECK(scene_text(other) != scene_text(scene));
}

TEST_CASE("a larger number of random spheres begins with the spheres of a smaller one",
          "[generate]")
{
    const Scene few = generate_random_spheres({.count = 10});
    const Scene many = generate_random_spheres({.count = 100});
    for (std::size_t i = 0; i < 10; ++i)
        CHECK(sphere(few, i).center == sphere(many, i).center);
    // Fixed numbers detect a change of the generator.
    CHECK(sphere(few, 0).center == Vec3(0.0822465, 0.6428519, 0.289059));
}

TEST_CASE("a lattice's spheres are all in different places", "[generate]")
{
    const Scene scene = generate_lattice({.edge = 5, .radius = 0.5});
    std::set<std::vector<double>> places;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Vec3 c = sphere(scene, i).center;
        places.insert({c.x, c.y, c.z});
        CHECK(sphere(scene, i).radius == Approx(0.1));
    }
    CHECK(places.size() == 125);
    CHECK(*places.begin() == std::vector<double>{0.1, 0.1, 0.1});
}

TEST_CASE("generators refuse options out of their ranges", "[generate]")
{
    CHECK(refusal([] { return generate_sphereflake({.depth = 8}); }) ==
          "depth: 8 is out of range; use a number from 0 to 7");
    CHECK(refusal([] { return generate_sphereflake({.reflective = 1.5}); }) ==
          "reflective: 1.5 is out of range; use a number from 0 to 1");
    CHECK(refusal([] { return generate_random_spheres({.count = 0}); }) ==
          "count: 0 is out of range; use a number from 1 to 10000000");
    CHECK(refusal([] { return generate_random_spheres({.count = 1, .radius = -1}); }) ==
          "radius: -1 is out of range; use a finite number above 0");
    CHECK(refusal([] { return generate_lattice({.edge = 216}); }) ==
          "edge: 216 is out of range; use a number from 1 to 215");
}

TEST_CASE("a generated scene's text reads as the same scene", "[generate]")
{
    check_round_trip(generate_sphereflake({.depth = 3, .reflective = 0.3, .ground = true}));
    check_round_trip(generate_random_spheres({.count = 1000, .radius = 0.1 / 3.0}));
    check_round_trip(generate_lattice({.edge = 7}));

    const Scene scene = generate_sphereflake({.depth = 3, .reflective = 0.3});
    const Scene read = test::parse(scene_text(scene));
    CHECK(read.camera.rotation == scene.camera.rotation);
    CHECK(read.camera.fov == scene.camera.fov);
    CHECK(read.objects.back().material.name == "flake");
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        CHECK(sphere(read, i).center == sphere(scene, i).center);
        CHECK(sphere(read, i).radius == sphere(scene, i).radius);
    }
}

TEST_CASE("every scene of the folder survives being written", "[generate]")
{
    for (const auto& entry : std::filesystem::directory_iterator(PACKTRACE_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".scene")
            continue;
        INFO(entry.path());
        check_round_trip(read_scene(entry.path()));
    }
}

TEST_CASE("every example of the language's reference survives being written", "[generate]")
{
    for (const std::string& example : test::scene_examples()) {
        INFO(example);
        check_round_trip(test::parse(example));
    }
}

TEST_CASE("scenes that the language can't express are not written", "[generate]")
{
    Scene scene = generate_sphereflake({.depth = 0});
    scene.objects[0].name = "a \"b\"";
    CHECK(
        refusal([&] { return scene_text(scene); }) ==
        "sphere 'a \"b\"': 'name' is 'a \"b\"', which no scene file can hold; leave out quotation "
        "marks and control characters");
    scene = generate_sphereflake({.depth = 0});
    scene.objects[0].material.color.x = 1.5;
    CHECK(refusal([&] { return scene_text(scene); }) ==
          "material 'flake': 'color' is 1.5; use a number from 0 to 1");
    scene = generate_sphereflake({.depth = 0});
    scene.objects[0].material.model = ShaderMaterial{};
    CHECK(refusal([&] { return scene_text(scene); }) ==
          "sphere 1: the material is one of illumination = shader, the scene's is scratch; give it "
          "the scene's, see make_material()");
}

TEST_CASE("generate writes a file that reads back, or standard output", "[generate]")
{
    const TempFolder folder;
    const std::string file = (folder / "a.scene").string();
    REQUIRE(run_packtrace({"generate", "sphereflake", "--depth", "2", "--ground", "--size", "64x48",
                           "--reflective", "0.25", "-o", file})
                .exit_code == 0);
    const Scene scene = read_scene(file);
    CHECK(scene.objects.size() == 92);
    CHECK(scene.width == 64);
    CHECK(scene.height == 48);
    CHECK(std::get<ScratchMaterial>(scene.objects[0].material.model).reflective == 0.25);
    const auto printed =
        run_packtrace({"generate", "random", "--count", "3", "--radius", "0.5", "--seed", "9"});
    CHECK(printed.out ==
          scene_text(generate_random_spheres({.count = 3, .radius = 0.5, .seed = 9})));
    CHECK(run_packtrace({"generate", "lattice", "--edge", "2", "--radius", "0.25"}).out ==
          scene_text(generate_lattice({.edge = 2, .radius = 0.25})));
}

TEST_CASE("generate refuses wrong use in a line", "[generate]")
{
    const std::vector<std::vector<std::string>> wrong = {
        {"generate"},
        {"generate", "fractal"},
        {"generate", "sphereflake", "--depth", "8"},
        {"generate", "sphereflake", "--count", "8"},
        {"generate", "random", "--count", "0"},
        {"generate", "random", "--radius", "0"},
        {"generate", "random", "--seed", "x"},
        {"generate", "random", "--seed", "-1"},
        {"generate", "lattice", "--edge", "216"},
        {"generate", "lattice", "--size", "0x4"},
    };
    for (const auto& words : wrong) {
        const auto result = run_packtrace(words);
        INFO(result.err);
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        CHECK(result.err.find('\n') == result.err.size() - 1);
    }
    const auto mirror = run_packtrace({"generate", "lattice", "--reflective", "1.5"});
    CHECK(mirror.exit_code == 2);
    CHECK_THAT(mirror.err, ContainsSubstring("--reflective: '1.5' is not a number from 0 to 1"));
}

TEST_CASE("a scene file that can't be written is named, and no file is left", "[generate]")
{
    const TempFolder folder;
    const std::string file = (folder / "none" / "a.scene").string();
    const auto result = run_packtrace({"generate", "lattice", "-o", file});
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, ContainsSubstring(file + ": can't write"));
    CHECK(folder.names().empty());
}

}  // namespace packtrace
