// Which points a light reaches: RayScene::lit() against occluded() with rays to the light. Points
// are hits of camera rays, and hits of their mirrored rays, whose shadow rays are spread.
#include "names.hpp"
#include "peers/ray_set.hpp"
#include "register.hpp"
#include "render/ray_columns.hpp"
#include "scenes.hpp"
#include <packtrace/camera.hpp>
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace packtrace::bench {
namespace {

constexpr int edge = 512;

/// After this many points all scenes here have built the light's buffer.
constexpr std::size_t enough_points = 2'000'000;

/// Shadow rays from the light end this much before the point.
constexpr float end_gap = 1e-5f;

using peers::RaySet;

constexpr double endless_ray = std::numeric_limits<double>::infinity();

/// The hits of rays, without the misses.
struct Points {
    std::array<std::vector<float>, 3> point, normal, outer;
    std::vector<std::int32_t> surface;
    std::vector<Vec3> dir;  ///< of the rays
};

Points points_of(const RayScene<float>& scene, const RaySet& rays)
{
    LeftHitColumns<float> hits(rays.size());
    scene.closest_hits(rays.view(0, rays.size()), hits.view());
    Points points;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits.object[i] < 0)
            continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            points.normal[axis].push_back(hits.normal[axis][i]);
            points.point[axis].push_back(hits.point[axis][i]);
            points.outer[axis].push_back(hits.outer_start[axis][i]);
        }
        points.surface.push_back(hits.surface[i]);
        points.dir.push_back({rays.dir[0][i], rays.dir[1][i], rays.dir[2][i]});
    }
    return points;
}

RaySet camera_rays(const Scene& scene)
{
    const CameraBasis basis = camera_basis(scene.camera, edge, edge);
    RaySet rays;
    for (int row = 0; row < edge; ++row)
        for (int column = 0; column < edge; ++column)
            rays.add(basis.origin,
                     basis.forward + (column + 0.5 - edge / 2) * basis.right +
                         (edge / 2 - row - 0.5) * basis.up,
                     endless_ray);
    return rays;
}

RaySet mirrored_rays(const Points& points)
{
    RaySet rays;
    for (std::size_t i = 0; i < points.surface.size(); ++i) {
        const Vec3 normal = vector_at(points.normal, i);
        rays.add(vector_at(points.outer, i),
                 points.dir[i] - 2 * glm::dot(points.dir[i], normal) * normal, endless_ray);
    }
    return rays;
}

/// Where the points come from, and by which function they are tested.
enum class Source { camera, mirrored };
enum class Query { lit, occluded };

/// The points whose surface faces one light.
struct Asked {
    std::unique_ptr<RayScene<float>> scene;
    std::array<std::vector<float>, 3> point;
    std::vector<std::int32_t> surface;
    RaySet shadow_rays;
    std::vector<std::uint8_t> mask;

    [[nodiscard]] PointsView<float> points() const
    {
        return {
            {point[0].data(), point[1].data(), point[2].data()}, surface.data(), surface.size()};
    }
};

Asked ask(const Scene& scene, std::size_t light, Source source)
{
    Asked asked;
    asked.scene = std::make_unique<RayScene<float>>(scene);
    Points points = points_of(*asked.scene, camera_rays(scene));
    if (source == Source::mirrored)
        points = points_of(*asked.scene, mirrored_rays(points));
    const Light& from = scene.lights[light];
    const bool endless = from.type == LightType::directional;
    for (std::size_t i = 0; i < points.surface.size(); ++i) {
        const Vec3 way = endless ? from.vector : from.vector - vector_at(points.point, i);
        if (glm::dot(way, vector_at(points.normal, i)) <= 0)
            continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
            asked.point[axis].push_back(points.point[axis][i]);
        asked.surface.push_back(points.surface[i]);
        // From the light: rays with a common origin are fastest.
        const Vec3 start = vector_at(points.outer, i);
        if (endless)
            asked.shadow_rays.add(start, from.vector, endless_ray);
        else
            asked.shadow_rays.add(from.vector, start - from.vector, 1.0f - end_gap);
    }
    asked.mask.resize(asked.surface.size());
    return asked;
}

Scene shapes_of(const std::string& name)
{
    if (name == "four_spheres")
        return test::four_spheres(edge, edge);
    if (name.starts_with("flake"))
        return generate_sphereflake({.depth = std::stoi(name.substr(5))});
    const int count = std::stoi(name.substr(6));
    return generate_random_spheres({.count = count, .radius = 0.3 / std::cbrt(count)});
}

Scene lit_scene(const std::string& name)
{
    Scene scene = shapes_of(name);
    scene.lights = {{LightType::point, Rgb(0.6), {4, 6, -4}},
                    {LightType::directional, Rgb(0.2), {4, 6, -4}}};
    return scene;
}

void run(benchmark::State& state, const std::string& name, std::size_t light, Source source,
         Query query)
{
    Asked asked = ask(lit_scene(name), light, source);
    const bool by_lit = query == Query::lit;
    // The light's buffer is built after enough points: here before the timed loop.
    for (std::size_t points = 0; by_lit && points < enough_points; points += asked.mask.size())
        asked.scene->lit(asked.points(), light, asked.mask.data());
    const RaysView<float> rays = asked.shadow_rays.view(0, asked.shadow_rays.size());
    for (auto _ : state) {
        if (by_lit)
            asked.scene->lit(asked.points(), light, asked.mask.data());
        else
            asked.scene->occluded(rays, asked.mask.data());
        benchmark::DoNotOptimize(asked.mask.data());
    }
    std::int64_t reached = 0;
    for (const std::uint8_t bit : asked.mask)
        reached += by_lit ? bit : 1 - bit;
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(asked.mask.size()));
    state.counters["points"] = static_cast<double>(asked.mask.size());
    state.counters["lit"] = static_cast<double>(reached);
}

}  // namespace

void register_lit()
{
    for (const char* scene : {"four_spheres", "flake4", "flake5", "random10000", "random100000"})
        for (const Source source : {Source::camera, Source::mirrored})
            for (const std::size_t light : {std::size_t{0}, std::size_t{1}})
                for (const Query query : {Query::lit, Query::occluded})
                    benchmark::RegisterBenchmark(
                        benchmark_name({"lit", scene, light == 0 ? "point" : "directional",
                                        source == Source::mirrored ? "mirrored" : "camera",
                                        query == Query::lit ? "lit" : "occluded"})
                            .c_str(),
                        [=, name = std::string(scene)](benchmark::State& state) {
                            run(state, name, light, source, query);
                        })
                        ->UseRealTime()
                        ->Unit(benchmark::kMillisecond);
}

}  // namespace packtrace::bench
