// packtrace_peers: races Embree, in all its modes, against packtrace on the same rays.
// docs/peers.md explains the races and the columns.
#include "builds.hpp"
#include "context.hpp"
#include "core/atomic_file.hpp"
#include "embree_modes.hpp"
#include "names.hpp"
#include "packtrace_modes.hpp"
#include "program.hpp"
#include "raced_scenes.hpp"
#include "report.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace packtrace::peers {
namespace {

struct Arguments {
    std::vector<std::string> scenes = scene_names();
    std::vector<std::string> kinds{"camera", "shadow", "bounce"};
    std::vector<std::string> isas{"avx512", "avx2"};
    std::vector<std::string> accuracies{"fast", "exact"};
    std::string json;
    int repetitions = 9;
    int size = 1024;
    int most_objects = 10'000'000;
    bool quick = false;
    bool builds = false;
    bool check = false;
};

std::vector<PacktraceMode> modes_of(const Arguments& arguments)
{
    std::vector<PacktraceMode> modes;
    const std::vector<std::string> supported = bench::supported_isas();
    for (const std::string& isa : arguments.isas)
        for (const std::string& accuracy : arguments.accuracies)
            if (std::count(supported.begin(), supported.end(), isa) > 0)
                modes.push_back({isa + " " + accuracy, isa,
                                 accuracy == "fast" ? Accuracy::fast : Accuracy::exact});
    return modes;
}

std::vector<Tracer> tracers_for(const Scene& scene, const Arguments& arguments,
                                const std::vector<SphereRecord>& spheres)
{
    std::vector<Tracer> tracers;
    if (scene.objects.size() <= static_cast<std::size_t>(arguments.most_objects))
        tracers = packtrace_tracers(scene, modes_of(arguments));
    const Modes modes = arguments.quick ? Modes::quick : Modes::all;
    for (const Geometry geometry : {Geometry::user, Geometry::sphere}) {
        if (arguments.quick && geometry == Geometry::sphere)
            continue;
        const auto built = std::make_shared<const EmbreeScene>(spheres, geometry);
        const auto more = embree_tracers(built, geometry, modes);
        tracers.insert(tracers.end(), more.begin(), more.end());
    }
    return tracers;
}

/// The start points of secondary rays, the same for all tracers.
std::vector<SurfacePoint> first_points(const Scene& scene, const RaySet& camera,
                                       const std::vector<Tracer>& tracers)
{
    Hits hits(camera.size());
    for (const Tracer& tracer : tracers)
        if (tracer.side == Side::embree_user) {
            (void)tracer.trace(camera, Query::closest, hits);
            return hit_points(scene, camera, hits);
        }
    return {};
}

Vec3 first_lamp(const Scene& scene)
{
    for (const Light& light : scene.lights)
        if (light.type == LightType::point)
            return light.vector;
    throw std::runtime_error("the scene has no point light");
}

std::vector<Heat> heats_of(const std::string& kind, const Scene& scene, const RaySet& camera,
                           const std::vector<SurfacePoint>& points)
{
    std::vector<Heat> heats;
    if (kind == "camera")
        heats.push_back({"", Query::closest, camera});
    if (kind == "bounce")
        heats.push_back({"", Query::closest, bounce_rays(points)});
    if (kind == "shadow") {
        const Vec3 lamp = first_lamp(scene);
        heats.push_back(
            {"from the light", Query::occluded, shadow_rays(points, lamp, ShadowEnd::light)});
        heats.push_back(
            {"from the surface", Query::occluded, shadow_rays(points, lamp, ShadowEnd::surface)});
    }
    return heats;
}

/// Compares the hits of both sides' best results on the same rays.
void compare_hits(const Scene& scene, const std::vector<Heat>& heats, Outcome& outcome)
{
    const Result* ours = best_of(outcome.results, Side::packtrace);
    if (ours == nullptr)
        return;
    for (const Heat& heat : heats) {
        std::vector<Result> same_end;
        for (const Result& result : outcome.results)
            if (result.end == heat.end && !result.own_rays)
                same_end.push_back(result);
        const Result& our = *best_of(same_end, Side::packtrace);
        const Result& their = *best_of(same_end, Side::embree_user);
        if (heat.query == Query::closest)
            outcome.agreement = compare_closest(scene, heat.rays, our.hits, their.hits);
        else if (heat.end == ours->end)
            outcome.occlusion_differences = count_occlusion_differences(our.hits, their.hits);
    }
}

/// One ray in so many may differ (docs/peers.md).
constexpr std::size_t rays_a_difference = 1000;

/// Throws std::runtime_error if the hits differ more than docs/peers.md promises.
void check_agreement(const Outcome& outcome)
{
    const auto& a = outcome.agreement;
    const bool hits_differ =
        a && (rays_a_difference * a->objects_differ > a->rays || a->ours_wrong > a->theirs_wrong);
    const double most = outcome.results.front().rays / static_cast<double>(rays_a_difference);
    const bool shadows_differ =
        static_cast<double>(outcome.occlusion_differences.value_or(0)) > most;
    if (hits_differ || shadows_differ)
        throw std::runtime_error(outcome.scene + ", " + outcome.kind +
                                 " rays: the hits disagree, see above");
}

nlohmann::ordered_json race_scene(const std::string& name, const Arguments& arguments)
{
    const Scene scene = raced_scene(name, arguments.size);
    const std::vector<SphereRecord> spheres = sphere_records(scene);
    const std::vector<Tracer> tracers = tracers_for(scene, arguments, spheres);
    const RaySet camera = camera_rays(scene);
    const auto points = first_points(scene, camera, tracers);
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const std::string& kind : arguments.kinds) {
        const auto heats = heats_of(kind, scene, camera, points);
        Outcome outcome{name, scene.objects.size(), kind, {}, {}, {}};
        outcome.results =
            race(heats, tracers, kind == "camera" ? HeatKind::camera : HeatKind::other,
                 arguments.repetitions);
        compare_hits(scene, heats, outcome);
        print(outcome);
        if (arguments.check)
            check_agreement(outcome);
        json.push_back(to_json(outcome));
    }
    return json;
}

nlohmann::ordered_json header(const std::string& command)
{
    nlohmann::ordered_json report;
    report["context"] = bench::context_json();
    report["context"]["embree"] = RTC_VERSION_STRING;
    report["context"]["command"] = command;
    return report;
}

void run(const Arguments& arguments, nlohmann::ordered_json report)
{
    std::optional<AtomicFile> file;
    if (!arguments.json.empty())
        file.emplace(arguments.json);
    report["races"] = nlohmann::ordered_json::array();
    for (const std::string& name : arguments.scenes)
        for (auto& outcome : race_scene(name, arguments))
            report["races"].push_back(outcome);
    if (arguments.builds) {
        report["builds"] = measure_builds(raced_scene("random1m", 16), arguments.repetitions);
        print_builds(report["builds"]);
    }
    if (!file)
        return;
    bench::add_load_after(report["context"]);
    file->write(report.dump(2) + "\n");
    file->commit();
}

void add_options(bench::Program& program, Arguments& arguments)
{
    program.words("--scenes", arguments.scenes, "Scenes to race on (default all)", scene_names());
    program.words("--kinds", arguments.kinds, "Kinds of rays: camera, shadow, bounce",
                  {"camera", "shadow", "bounce"});
    program.words("--isas", arguments.isas, "Instruction sets of packtrace (avx512,avx2)",
                  {"avx512", "avx2", "sse_fma", "sse42"});
    program.words("--accuracies", arguments.accuracies,
                  "Accuracy modes of packtrace (fast,exact); Embree's single precision compares "
                  "with fast",
                  {"fast", "exact"});
    program.number("--repetitions", arguments.repetitions, {1, 1000},
                   "Passes that count (default 9)");
    program.number("--size", arguments.size, {16, 8192, tile_size},
                   "Pixels of each edge (default 1024)");
    program.number("--max-packtrace-objects", arguments.most_objects, {0, 10'000'000},
                   "Leave packtrace out of scenes with more (default none)");
    program.text("--json", arguments.json, "Write all figures into this file");
    program.flag("--quick", arguments.quick, "Only three modes of Embree's, which mostly win");
    program.flag("--check", arguments.check, "Exit 1 where the hits disagree");
    program.flag("--builds", arguments.builds, "Measure building for a million spheres, too");
}

}  // namespace
}  // namespace packtrace::peers

int main(int argc, char** argv)
{
    using namespace packtrace::peers;
    packtrace::bench::Program program(
        "packtrace_peers", "Races packtrace against Embree on the same rays, one thread");
    Arguments arguments;
    add_options(program, arguments);
    return program.run(argc, argv, [&] { run(arguments, header(program.command_line())); });
}
