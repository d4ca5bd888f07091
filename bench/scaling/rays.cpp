// packtrace_rays: millions of a caller's rays per second, by kind, for one scene, instruction set
// and accuracy; as JSON. results/exact_cost.py builds this source with several versions of the
// library and runs them by turns, so it uses only what these versions have in common.
#include "core/seconds_since.hpp"
#include "peers/camera_tiles.hpp"
#include "peers/raced_scenes.hpp"
#include "peers/ray_set.hpp"
#include "program.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <string>
#include <type_traits>
#include <vector>

namespace packtrace::peers {
namespace {

struct Arguments {
    std::string scene = "four_spheres";
    std::string isa = "avx512";
    int size = 512;
    int repetitions = 3;
    bool fast = false;
    bool in_double = false;
};

/// Rays in one call.
constexpr std::size_t batch = 4096;

/// A kind of rays, and one pass over all of them, which returns seconds.
struct Subject {
    std::string name;
    std::size_t rays;
    std::function<double()> pass;
};

/// For `spheres<N>`, N spheres in the unit cube; else a scene of raced_scenes.hpp.
Scene scene_of(const Arguments& arguments)
{
    if (!arguments.scene.starts_with("spheres"))
        return raced_scene(arguments.scene, arguments.size);
    Scene scene = generate_random_spheres(
        {.count = std::stoi(arguments.scene.substr(7)), .radius = 0.4, .reflective = 0.0});
    scene.width = scene.height = arguments.size;
    return scene;
}

/// The same rays in either precision.
template <class Real>
class Rays {
public:
    explicit Rays(const RaySet& rays)
    {
        const std::vector<float>* const from[8] = {&rays.org[0], &rays.org[1], &rays.org[2],
                                                   &rays.dir[0], &rays.dir[1], &rays.dir[2],
                                                   &rays.t_min,  &rays.t_max};
        for (int i = 0; i < 8; ++i)
            values_[i].assign(from[i]->begin(), from[i]->end());
    }
    [[nodiscard]] std::size_t size() const
    {
        return values_[0].size();
    }
    [[nodiscard]] RaysView<Real> view(std::size_t first) const
    {
        const auto at = [&](int i) { return values_[i].data() + first; };
        return {at(0), at(1), at(2),
                at(3), at(4), at(5),
                at(6), at(7), std::min(batch, size() - first)};
    }

private:
    std::vector<Real> values_[8];
};

/// The arrays that passes over rays write to.
template <class Real>
struct Answers {
    std::vector<Real> t;
    std::vector<std::int32_t> object;
    std::vector<std::uint8_t> occluded;

    explicit Answers(std::size_t size) : t(size), object(size), occluded(size)
    {
    }
};

template <class Query>
double seconds_over(std::size_t rays, const Query& query)
{
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t first = 0; first < rays; first += batch)
        query(first);
    return seconds_since(begin);
}

template <class Real>
double closest(const RayScene<Real>& scene, const Rays<Real>& rays, Answers<Real>& answers)
{
    return seconds_over(rays.size(), [&](std::size_t first) {
        scene.closest_hits(rays.view(first),
                           {answers.t.data() + first, answers.object.data() + first, {}, {}, {}});
    });
}

template <class Real>
double occluded(const RayScene<Real>& scene, const Rays<Real>& rays, Answers<Real>& answers)
{
    return seconds_over(rays.size(), [&](std::size_t first) {
        scene.occluded(rays.view(first), answers.occluded.data() + first);
    });
}

Vec3 first_light(const Scene& scene)
{
    for (const Light& light : scene.lights)
        if (light.type == LightType::point)
            return light.vector;
    return {4, 6, -4};
}

/// The points that camera rays hit.
std::vector<SurfacePoint> points_of(const Scene& scene, const RaySet& camera,
                                    const RenderOptions& options)
{
    const RayScene<float> rays(scene, options);
    Answers<float> answers(camera.size());
    (void)closest(rays, Rays<float>(camera), answers);
    Hits hits(0);
    hits.t = answers.t;
    hits.object = answers.object;
    return hit_points(scene, camera, hits);
}

double best_of(int repetitions, const std::function<double()>& pass)
{
    double best = pass();
    for (int i = 0; i < repetitions; ++i)
        best = std::min(best, pass());
    return best;
}

template <class Real>
nlohmann::ordered_json run(const Arguments& arguments)
{
    const Scene scene = scene_of(arguments);
    RenderOptions options{.isa = arguments.isa};
    if (arguments.fast)
        options.accuracy = Accuracy::fast;
    const RaySet camera_set = camera_rays(scene);
    const std::vector<SurfacePoint> points = points_of(scene, camera_set, options);
    const Rays<Real> camera(camera_set);
    const Rays<Real> bounce(bounce_rays(points));
    const Rays<Real> from_surface(shadow_rays(points, first_light(scene), ShadowEnd::surface));
    const Rays<Real> from_light(shadow_rays(points, first_light(scene), ShadowEnd::light));
    const RayScene<Real> rays(scene, options);
    Answers<Real> answers(camera.size());
    Hits hits(camera.size());
    CameraTiles tiles(scene, options.isa, options.accuracy);
    std::vector<Subject> subjects = {
        {"camera", camera.size(), [&] { return closest(rays, camera, answers); }},
        {"bounce", bounce.size(), [&] { return closest(rays, bounce, answers); }},
        {"shadow, from the surface", from_surface.size(),
         [&] { return occluded(rays, from_surface, answers); }},
        {"shadow, from the light", from_light.size(),
         [&] { return occluded(rays, from_light, answers); }}};
    if (std::is_same_v<Real, float>)
        subjects.push_back({"tiles", camera.size(), [&] { return tiles.trace(hits); }});
    nlohmann::ordered_json rates;
    for (const Subject& subject : subjects)
        rates[subject.name] =
            1e-6 * static_cast<double>(subject.rays) / best_of(arguments.repetitions, subject.pass);
    return rates;
}

}  // namespace
}  // namespace packtrace::peers

int main(int argc, char** argv)
{
    using namespace packtrace::peers;
    Arguments arguments;
    packtrace::bench::Program program(
        "packtrace_rays",
        "Millions of a caller's rays a second, the best of some passes on one thread");
    program.text("SCENE", arguments.scene, "four_spheres, flake4, flake6, random1m or spheres<N>");
    program.text("--isa", arguments.isa, "Instruction set");
    program.number("--size", arguments.size, {16, 8192, tile_size}, "Edge of the picture");
    program.number("--repetitions", arguments.repetitions, {1, 1000},
                   "Passes over each kind of rays");
    program.flag("--double", arguments.in_double, "Rays in double precision");
    program.flag("--fast", arguments.fast, "Accuracy::fast instead of the default");
    return program.run(argc, argv, [&] {
        const auto rates = arguments.in_double ? run<double>(arguments) : run<float>(arguments);
        std::cout << rates.dump(1) << '\n';
    });
}
