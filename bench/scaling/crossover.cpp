// packtrace_crossover: from how many spheres on a hierarchy is faster than a list, for frames and
// for streams of camera, shadow and bounce rays; as JSON.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <packtrace/generate.hpp>
#include <packtrace/renderer.hpp>

#include <tbb/global_control.h>

#include "context.hpp"
#include "peers/ray_set.hpp"

namespace packtrace {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::vector<int> objects = {4, 8, 12, 16, 24, 32, 48, 64, 96, 128};
    int size = 512;
    int repetitions = 9;
    double cover = 1.0;
    std::string isa = "auto";
};

constexpr Traversal kinds[] = {Traversal::list, Traversal::tree};
constexpr const char* kind_names[] = {"list", "tree"};

/// What is measured, through either of the kinds.
struct Subject {
    std::string name;
    std::function<void()> through[2];
};

/// As in the study of scaling: scenes differ in their grain alone.
Scene scene_of(const Arguments& arguments, int objects)
{
    const double radius = std::sqrt(arguments.cover / objects);
    Scene scene = generate_random_spheres({.count = objects, .radius = radius});
    scene.width = scene.height = arguments.size;
    return scene;
}

double seconds_of(const std::function<void()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Both kinds by turns; the first turn only warms up.
Json measure(const Subject& subject, int repetitions)
{
    std::vector<double> seconds[2];
    std::vector<double> ratios;
    for (int turn = 0; turn <= repetitions; ++turn) {
        double now[2];
        for (int kind = 0; kind < 2; ++kind)
            now[kind] = seconds_of(subject.through[kind]);
        if (turn == 0)
            continue;
        for (int kind = 0; kind < 2; ++kind)
            seconds[kind].push_back(now[kind]);
        ratios.push_back(now[1] / now[0]);
    }
    return {{"rays", subject.name},
            {"list_seconds", median(seconds[0])},
            {"tree_seconds", median(seconds[1])},
            {"tree_over_list", median(ratios)},
            {"least", *std::min_element(ratios.begin(), ratios.end())},
            {"most", *std::max_element(ratios.begin(), ratios.end())}};
}

/// One scene, made ready both ways.
class Race {
public:
    Race(const Arguments& arguments, int objects) : scene_(scene_of(arguments, objects))
    {
        RenderOptions options;
        options.isa = arguments.isa;
        options.threads = 1;
        for (const Traversal kind : kinds) {
            options.traversal = kind;
            renderers_.emplace_back(scene_, options);
            ray_scenes_.emplace_back(scene_, options);
        }
        make_rays();
    }

    [[nodiscard]] std::vector<Subject> subjects()
    {
        return {subject("frame", [this](std::size_t kind) { renderers_[kind].render(image_); }),
                subject("camera", [this](std::size_t kind) { closest(kind, camera_); }),
                subject("shadow", [this](std::size_t kind) { occluded(kind, shadow_); }),
                subject("bounce", [this](std::size_t kind) { closest(kind, bounce_); })};
    }

private:
    template <class Work>
    static Subject subject(const std::string& name, const Work& work)
    {
        return {name, {[work] { work(0); }, [work] { work(1); }}};
    }

    void make_rays()
    {
        camera_ = peers::camera_rays(scene_);
        hits_ = peers::Hits(camera_.size());
        closest(0, camera_);
        const auto points = peers::hit_points(scene_, camera_, hits_);
        for (const Light& light : scene_.lights)
            if (light.type == LightType::point)
                shadow_ = peers::shadow_rays(points, light.vector, peers::ShadowEnd::light);
        bounce_ = peers::bounce_rays(points);
    }

    void closest(std::size_t kind, const peers::RaySet& rays)
    {
        ray_scenes_[kind].closest_hits(rays.view(0, rays.size()),
                                       {hits_.t.data(), hits_.object.data(), {}, {}, {}});
    }
    void occluded(std::size_t kind, const peers::RaySet& rays)
    {
        ray_scenes_[kind].occluded(rays.view(0, rays.size()), hits_.occluded.data());
    }

    Scene scene_;
    std::vector<Renderer<float>> renderers_;
    std::vector<RayScene<float>> ray_scenes_;
    peers::RaySet camera_, shadow_, bounce_;
    peers::Hits hits_{0};
    Image<float> image_;
};

void print_report(const Arguments& arguments)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    Json report;
    for (const auto& [name, value] : bench::context())
        report["context"][name] = value;
    report["points"] = Json::array();
    for (const int objects : arguments.objects) {
        Race race(arguments, objects);
        for (const Subject& subject : race.subjects()) {
            Json point{{"objects", objects}};
            point.update(measure(subject, arguments.repetitions));
            report["points"].push_back(point);
            std::fprintf(stderr, "%4d spheres  %-7s  %s/%s %.3f\n", objects, subject.name.c_str(),
                         kind_names[1], kind_names[0], point["tree_over_list"].get<double>());
        }
    }
    std::cout << report.dump(2) << '\n';
}

void add_options(CLI::App& app, Arguments& arguments)
{
    app.add_option("--objects", arguments.objects, "Numbers of spheres (default 4 … 128)")
        ->check(CLI::Range(1, 100'000))
        ->delimiter(',');
    app.add_option("--size", arguments.size, "Pixels of each edge, a multiple of 16 (default 512)")
        ->check(CLI::Range(1, 1024) & CLI::Validator(
                                          [](const std::string& text) {
                                              return std::stoi(text) % peers::tile_size == 0
                                                         ? std::string()
                                                         : "must be a multiple of 16, not " + text;
                                          },
                                          "multiple of 16"));
    app.add_option("--repetitions", arguments.repetitions, "Turns (default 9)")
        ->check(CLI::Range(1, 1000));
    app.add_option("--cover", arguments.cover, "Squares of all radii together (default 1)")
        ->check(CLI::Range(1e-9, 1e3));
    app.add_option("--isa", arguments.isa, "Instruction set (default the widest)");
}

}  // namespace
}  // namespace packtrace

int main(int argc, char** argv)
{
    CLI::App app{"List against hierarchy, over the number of spheres, as JSON"};
    packtrace::Arguments arguments;
    packtrace::add_options(app, arguments);
    try {
        app.parse(argc, argv);
        packtrace::print_report(arguments);
    } catch (const CLI::ParseError& end) {
        return app.exit(end) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::cerr << "packtrace_crossover: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
