// packtrace_crossover: the number of spheres from which on a BVH is faster than lists, for frames
// and for streams of camera, shadow and bounce rays, by instruction set; as JSON.
#include "context.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/harness/stopwatch.hpp"
#include "names.hpp"
#include "peers/ray_set.hpp"
#include "program.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/renderer.hpp>

#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>

namespace packtrace {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::vector<int> objects = {16, 32, 64, 96, 128, 192, 256, 384, 512, 768, 1024};
    std::vector<int> sizes = {512};
    std::vector<double> covers = {1.0, 8.0};
    std::vector<double> mirrors = {0.0, 0.4};
    std::vector<std::string> isas;
    int repetitions = 9;
    bool fast = false;

    [[nodiscard]] RenderOptions options(const std::string& isa) const
    {
        return {.isa = isa, .accuracy = fast ? Accuracy::fast : Accuracy::exact, .threads = 1};
    }
};

/// The settings of a crossover: all but the number of spheres.
struct Setting {
    int size = 512;
    double cover = 1.0;
    double mirror = 0.0;

    [[nodiscard]] Json json() const
    {
        return {{"size", size}, {"cover", cover}, {"mirror", mirror}};
    }
};

constexpr std::array<Traversal, 2> kinds = {Traversal::list, Traversal::tree};

/// What is measured, with each of `kinds`.
struct Subject {
    std::string name;
    std::function<void()> through[2];
};

/// As in scaling.cpp: the total cross-section of the spheres does not depend on their number.
Scene scene_of(const Setting& setting, int objects)
{
    const double radius = std::sqrt(setting.cover / objects);
    Scene scene =
        generate_random_spheres({.count = objects, .radius = radius, .reflective = setting.mirror});
    scene.width = scene.height = setting.size;
    return scene;
}

/// One scene, prepared with both kinds for an instruction set, and its measurements.
class Race {
public:
    Race(const Scene& scene, RenderOptions options) : isa_(options.isa), scene_(scene)
    {
        for (const Traversal kind : kinds) {
            options.traversal = kind;
            renderers_.emplace_back(scene_, options);
            ray_scenes_.emplace_back(scene_, options);
        }
        make_rays();
        subjects_ = {
            subject("frame", [this](std::size_t kind) { renderers_[kind].render(image_); }),
            subject("camera", [this](std::size_t kind) { closest(kind, camera_); }),
            subject("shadow", [this](std::size_t kind) { occluded(kind, shadow_); }),
            subject("bounce", [this](std::size_t kind) { closest(kind, bounce_); })};
        seconds_.resize(subjects_.size());
    }
    Race(const Race&) = delete;
    Race& operator=(const Race&) = delete;

    /// Measures each subject with both kinds, right after each other.
    void take_turn()
    {
        for (std::size_t i = 0; i < subjects_.size(); ++i)
            for (std::size_t kind = 0; kind < kinds.size(); ++kind)
                seconds_[i][kind].push_back(seconds_of(1, subjects_[i].through[kind]));
    }
    /// Drops all measurements so far, which were to warm up.
    void forget()
    {
        for (auto& of_subject : seconds_)
            for (auto& of_kind : of_subject)
                of_kind.clear();
    }

    [[nodiscard]] const std::string& isa() const
    {
        return isa_;
    }
    [[nodiscard]] std::size_t subject_count() const
    {
        return subjects_.size();
    }
    [[nodiscard]] const std::string& name(std::size_t subject) const
    {
        return subjects_[subject].name;
    }
    [[nodiscard]] std::vector<double> ratios(std::size_t subject) const
    {
        std::vector<double> result;
        for (std::size_t i = 0; i < seconds_[subject][0].size(); ++i)
            result.push_back(seconds_[subject][1][i] / seconds_[subject][0][i]);
        return result;
    }
    [[nodiscard]] double seconds(std::size_t subject, std::size_t kind) const
    {
        return median_of(seconds_[subject][kind]);
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

    std::string isa_;
    Scene scene_;
    std::vector<Renderer<float>> renderers_;
    std::vector<RayScene<float>> ray_scenes_;
    peers::RaySet camera_, shadow_, bounce_;
    peers::Hits hits_{0};
    Image<float> image_;
    std::vector<Subject> subjects_;
    std::vector<std::array<std::vector<double>, 2>> seconds_;
};

/// The measurements of one kind of rays with one number of spheres.
struct Point {
    int objects = 0;
    double list_seconds = 0.0;
    double tree_seconds = 0.0;
    std::vector<double> ratios;  ///< tree over list, by turn

    [[nodiscard]] double ratio() const
    {
        return median_of(ratios);
    }
    [[nodiscard]] Json json() const
    {
        Json json{{"objects", objects},
                  {"list_seconds", list_seconds},
                  {"tree_seconds", tree_seconds},
                  {"tree_over_list", ratio()},
                  {"least", *std::min_element(ratios.begin(), ratios.end())},
                  {"most", *std::max_element(ratios.begin(), ratios.end())}};
        if (const std::optional<Interval> interval = median_interval(ratios))
            json["interval_99"] = {interval->low, interval->high};
        return json;
    }
};

/// The number of objects from which on the ratio stays below 1, interpolated linearly between the
/// logarithms of the measured numbers. None if the ratio never or always stays below 1.
std::optional<double> crossing_of(const std::vector<Point>& points)
{
    std::size_t first = points.size();
    while (first > 0 && points[first - 1].ratio() < 1.0)
        --first;
    if (first == 0 || first == points.size())
        return std::nullopt;
    const Point& above = points[first - 1];
    const Point& below = points[first];
    const double high = std::log(above.ratio());
    const double share = high / (high - std::log(below.ratio()));
    return above.objects * std::pow(static_cast<double>(below.objects) / above.objects, share);
}

/// The points of one instruction set and kind of rays in one setting.
struct Curve {
    std::string isa;
    std::string rays;
    std::vector<Point> points;

    [[nodiscard]] Json json(const Setting& setting) const
    {
        Json json{{"isa", isa}, {"rays", rays}};
        json.update(setting.json());
        const std::optional<double> crossing = crossing_of(points);
        json["tree_wins_from"] = crossing ? Json(std::round(*crossing)) : Json();
        json["points"] = Json::array();
        for (const Point& point : points)
            json["points"].push_back(point.json());
        return json;
    }
};

/// Measures all instruction sets by turns, so that a busy moment of the machine affects all. The
/// first turn is to warm up.
void add_points(const Arguments& arguments, const Setting& setting, int objects,
                std::vector<Curve>& curves)
{
    const Scene scene = scene_of(setting, objects);
    std::vector<std::unique_ptr<Race>> races;
    for (const std::string& isa : arguments.isas)
        races.push_back(std::make_unique<Race>(scene, arguments.options(isa)));
    for (int turn = 0; turn <= arguments.repetitions; ++turn)
        for (const auto& race : races) {
            race->take_turn();
            if (turn == 0)
                race->forget();
        }
    std::size_t curve = 0;
    for (const auto& race : races)
        for (std::size_t i = 0; i < race->subject_count(); ++i, ++curve) {
            if (curve == curves.size())
                curves.push_back({race->isa(), race->name(i), {}});
            curves[curve].points.push_back(
                {objects, race->seconds(i, 0), race->seconds(i, 1), race->ratios(i)});
        }
}

Json curves_json(const Arguments& arguments, const Setting& setting)
{
    std::vector<Curve> curves;
    for (const int objects : arguments.objects)
        add_points(arguments, setting, objects, curves);
    Json json = Json::array();
    for (const Curve& curve : curves) {
        json.push_back(curve.json(setting));
        std::cerr << setting.size << " x " << setting.size << ", cover " << setting.cover
                  << ", mirror " << setting.mirror << ", " << curve.isa << ", " << curve.rays
                  << ": tree wins from " << json.back()["tree_wins_from"].dump() << '\n';
    }
    return json;
}

void print_report(const Arguments& arguments, const std::string& command)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const auto start = std::chrono::steady_clock::now();
    const Stopwatch work(1);
    Json report{{"program", "packtrace_crossover"}, {"command", command}};
    report["context"] = bench::context_json();
    Json curves = Json::array();
    for (const int size : arguments.sizes)
        for (const double cover : arguments.covers)
            for (const double mirror : arguments.mirrors)
                for (const Json& curve : curves_json(arguments, {size, cover, mirror}))
                    curves.push_back(curve);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    // 1 on an idle machine, less if other programs ran.
    report["context"]["processor_share"] = work.seconds() / passed.count();
    bench::add_load_after(report["context"]);
    report["curves"] = curves;
    std::cout << report.dump(2) << '\n';
}

void add_options(bench::Program& program, Arguments& arguments)
{
    program.numbers("--objects", arguments.objects, {1, 100'000},
                    "Numbers of spheres (default 16 … 1024)");
    program.numbers("--size", arguments.sizes, {16, 1024, peers::tile_size},
                    "Pixels of each edge (default 512)");
    program.numbers("--cover", arguments.covers, {1e-9, 1e3},
                    "Squares of all radii together (default 1,8)");
    program.numbers("--mirror", arguments.mirrors, {0.0, 1.0},
                    "Shares of the light that the spheres mirror (default 0,0.4)");
    program.words("--isa", arguments.isas, "Instruction sets (default all of this machine)");
    program.number("--repetitions", arguments.repetitions, {1, 1000}, "Turns (default 9)");
    program.flag("--fast", arguments.fast, "Accuracy::fast instead of the default");
}

}  // namespace
}  // namespace packtrace

int main(int argc, char** argv)
{
    packtrace::bench::Program program(
        "packtrace_crossover", "List against hierarchy, over the number of spheres, as JSON");
    packtrace::Arguments arguments;
    packtrace::add_options(program, arguments);
    return program.run(argc, argv, [&] {
        if (arguments.isas.empty())
            arguments.isas = packtrace::bench::supported_isas();
        std::sort(arguments.objects.begin(), arguments.objects.end());
        packtrace::print_report(arguments, program.command_line());
    });
}
