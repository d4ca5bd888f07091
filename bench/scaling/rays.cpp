// packtrace_rays: how many millions of a caller's rays a second one scene, instruction set and
// accuracy bring, of each kind; as JSON. results/exact_cost.py runs programs of several versions by
// turns, so that this source keeps to what their libraries have in common.
#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>

#include "peers/camera_tiles.hpp"
#include "peers/raced_scenes.hpp"
#include "peers/ray_set.hpp"

namespace packtrace::peers {
namespace {

struct Arguments {
    std::string scene = "four_spheres";
    std::string isa = "avx512";
    int size = 512;
    int repetitions = 3;
    bool fast = false;
};

/// Rays that are handed over at once.
constexpr std::size_t batch = 4096;

/// A kind of rays, and one pass over all of them, which returns seconds.
struct Subject {
    std::string name;
    std::size_t rays;
    std::function<double()> pass;
};

/// `spheres<N>`: as many in a box of ten units; else one of raced_scenes.hpp.
Scene scene_of(const Arguments& arguments)
{
    if (!arguments.scene.starts_with("spheres"))
        return raced_scene(arguments.scene, arguments.size);
    Scene scene = generate_random_spheres(
        {.count = std::stoi(arguments.scene.substr(7)), .radius = 0.4, .reflective = 0.0});
    scene.width = scene.height = arguments.size;
    return scene;
}

template <class Query>
double seconds_over(const RaySet& rays, const Query& query)
{
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t first = 0; first < rays.size(); first += batch)
        query(rays.view(first, std::min(batch, rays.size() - first)), first);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double closest(const RayScene<float>& scene, const RaySet& rays, Hits& hits)
{
    return seconds_over(rays, [&](const RaysView<float>& view, std::size_t first) {
        scene.closest_hits(view, {hits.t.data() + first, hits.object.data() + first, {}, {}, {}});
    });
}

double occluded(const RayScene<float>& scene, const RaySet& rays, Hits& hits)
{
    return seconds_over(rays, [&](const RaysView<float>& view, std::size_t first) {
        scene.occluded(view, hits.occluded.data() + first);
    });
}

Vec3 first_light(const Scene& scene)
{
    for (const Light& light : scene.lights)
        if (light.type == LightType::point)
            return light.vector;
    return {4, 6, -4};
}

nlohmann::ordered_json run(const Arguments& arguments)
{
    const Scene scene = scene_of(arguments);
    RenderOptions options;
    options.isa = arguments.isa;
    if (arguments.fast)
        options.accuracy = Accuracy::fast;
    const RayScene<float> rays(scene, options);
    const RaySet camera = camera_rays(scene);
    Hits hits(camera.size());
    (void)closest(rays, camera, hits);
    const std::vector<SurfacePoint> points = hit_points(scene, camera, hits);
    const RaySet bounce = bounce_rays(points);
    const RaySet from_surface = shadow_rays(points, first_light(scene), ShadowEnd::surface);
    const RaySet from_light = shadow_rays(points, first_light(scene), ShadowEnd::light);
    CameraTiles tiles(scene, options.isa, options.accuracy);
    const std::vector<Subject> subjects = {
        {"tiles", camera.size(), [&] { return tiles.trace(hits); }},
        {"camera", camera.size(), [&] { return closest(rays, camera, hits); }},
        {"bounce", bounce.size(), [&] { return closest(rays, bounce, hits); }},
        {"shadow, from the surface", from_surface.size(),
         [&] { return occluded(rays, from_surface, hits); }},
        {"shadow, from the light", from_light.size(),
         [&] { return occluded(rays, from_light, hits); }}};
    nlohmann::ordered_json rates;
    for (const Subject& subject : subjects) {
        double best = subject.pass();
        for (int i = 0; i < arguments.repetitions; ++i)
            best = std::min(best, subject.pass());
        rates[subject.name] = 1e-6 * static_cast<double>(subject.rays) / best;
    }
    return rates;
}

}  // namespace
}  // namespace packtrace::peers

int main(int argc, char** argv)
{
    packtrace::peers::Arguments arguments;
    CLI::App app("Millions of a caller's rays a second, the best of some passes on one thread");
    app.add_option("SCENE", arguments.scene,
                   "four_spheres, flake4, flake6, random1m or spheres<N>");
    app.add_option("--isa", arguments.isa, "Instruction set");
    app.add_option("--size", arguments.size, "Edge of the picture, a multiple of 16");
    app.add_option("--repetitions", arguments.repetitions, "Passes over each kind of rays");
    app.add_flag("--fast", arguments.fast, "Accuracy::fast instead of the default");
    CLI11_PARSE(app, argc, argv);
    try {
        std::cout << packtrace::peers::run(arguments).dump(1) << '\n';
    } catch (const std::exception& error) {
        std::cerr << "packtrace_rays: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
