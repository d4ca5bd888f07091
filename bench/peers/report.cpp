#include "report.hpp"

#include <algorithm>
#include <cstdio>

namespace packtrace::peers {
namespace {

nlohmann::ordered_json to_json(const Agreement& a)
{
    return {{"rays", a.rays},
            {"hit_by_both", a.hit_by_both},
            {"objects_differ", a.objects_differ},
            {"objects_differ_on_ground", a.objects_differ_on_ground},
            {"ties", a.ties},
            {"packtrace_wrong", a.ours_wrong},
            {"embree_wrong", a.theirs_wrong},
            {"distances_differ", a.distances_differ},
            {"distances_differ_on_ground", a.distances_differ_on_ground},
            {"packtrace_largest_error", a.our_largest_error},
            {"embree_largest_error", a.their_largest_error}};
}

/// Speed relative to the best of each of Embree's geometries; 0 if that did not run.
struct Ratios {
    double user = 0.0;
    double sphere = 0.0;
};

Ratios ratios_of(const Result& result, const std::vector<Result>& results)
{
    Ratios ratios;
    if (const Result* user = best_of(results, Side::embree_user))
        ratios.user = median_ratio(result, *user);
    if (const Result* sphere = best_of(results, Side::embree_sphere))
        ratios.sphere = median_ratio(result, *sphere);
    return ratios;
}

nlohmann::ordered_json to_json(const Result& result, const std::vector<Result>& results)
{
    const Ratios ratios = ratios_of(result, results);
    nlohmann::ordered_json json{{"tracer", result.tracer},
                                {"mrays_median", result.median_rate()},
                                {"mrays_lowest", result.lowest_rate()},
                                {"mrays_highest", result.highest_rate()},
                                {"seconds", result.seconds}};
    if (!result.end.empty())
        json["end"] = result.end;
    if (ratios.user > 0.0)
        json["ratio_to_best_user"] = ratios.user;
    if (ratios.sphere > 0.0)
        json["ratio_to_best_sphere"] = ratios.sphere;
    return json;
}

void print_ratio(double ratio)
{
    if (ratio > 0.0)
        std::printf("%8.2f", ratio);
    else
        std::printf("%8s", "-");
}

void print(const Result& result, const std::vector<Result>& results)
{
    const Ratios ratios = ratios_of(result, results);
    std::printf("  %-34s %-17s %9.2f %9.2f %9.2f", result.tracer.c_str(), result.end.c_str(),
                result.median_rate(), result.lowest_rate(), result.highest_rate());
    print_ratio(ratios.user);
    print_ratio(ratios.sphere);
    std::printf("\n");
}

void print(const Agreement& a)
{
    std::printf(
        "  hits: %zu of %zu by both; other object %zu, on the ground %zu (wrong: packtrace "
        "%zu, Embree %zu), ties %zu;\n"
        "        other t %zu, on the ground %zu; largest error of t: packtrace %.2g, Embree "
        "%.2g\n",
        a.hit_by_both, a.rays, a.objects_differ, a.objects_differ_on_ground, a.ours_wrong,
        a.theirs_wrong, a.ties, a.distances_differ, a.distances_differ_on_ground,
        a.our_largest_error, a.their_largest_error);
}

}  // namespace

nlohmann::ordered_json to_json(const Outcome& outcome)
{
    nlohmann::ordered_json json{{"scene", outcome.scene},
                                {"objects", outcome.objects},
                                {"kind", outcome.kind},
                                {"rays", outcome.results.front().rays},
                                {"tracers", nlohmann::ordered_json::array()}};
    for (const Result& result : outcome.results)
        json["tracers"].push_back(to_json(result, outcome.results));
    if (outcome.agreement)
        json["agreement"] = to_json(*outcome.agreement);
    if (outcome.occlusion_differences)
        json["occlusion_differences"] = *outcome.occlusion_differences;
    return json;
}

void print(const Outcome& outcome)
{
    std::vector<Result> sorted = outcome.results;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Result& a, const Result& b) {
        return a.median_rate() > b.median_rate();
    });
    std::printf("\n%s, %zu objects, %s rays: %.0f\n", outcome.scene.c_str(), outcome.objects,
                outcome.kind.c_str(), sorted.front().rays);
    std::printf("  %-34s %-17s %9s %9s %9s%8s%8s\n", "million rays a second", "", "median",
                "lowest", "highest", "/user", "/sphere");
    for (const Result& result : sorted)
        print(result, outcome.results);
    if (outcome.agreement)
        print(*outcome.agreement);
    if (outcome.occlusion_differences)
        std::printf("  occluded for one side only: %zu\n", *outcome.occlusion_differences);
    std::fflush(stdout);
}

void print_builds(const nlohmann::ordered_json& builds)
{
    std::printf("\nbuilding for %zu spheres\n  %-16s %7s %12s %14s\n",
                builds.at(0).at("objects").get<std::size_t>(), "", "threads", "milliseconds",
                "bytes/object");
    for (const auto& build : builds)
        std::printf("  %-16s %7d %12.0f %14.0f\n", build.at("side").get<std::string>().c_str(),
                    build.at("threads").get<int>(), 1e3 * build.at("seconds").get<double>(),
                    build.at("bytes_an_object").get<double>());
}

}  // namespace packtrace::peers
