#include "cli/profile_kernels.hpp"

#include <algorithm>
#include <ostream>
#include <utility>

#include "cli/text_table.hpp"

namespace packtrace::cli {
namespace {

std::string milliseconds(double seconds)
{
    return fixed(1e3 * seconds, 3);
}

std::string percent(double part, double whole)
{
    return fixed(100.0 * part / whole, 1) + " %";
}

std::string ratio(std::uint64_t part, std::uint64_t whole)
{
    return whole > 0 ? fixed(static_cast<double>(part) / static_cast<double>(whole), 2) : "-";
}

double sum_of(const std::vector<KernelStage>& stages)
{
    double sum = 0.0;
    for (const KernelStage& stage : stages)
        sum += stage.seconds;
    return sum;
}

int last_depth(const std::vector<KernelStage>& stages)
{
    int depth = 0;
    for (const KernelStage& stage : stages)
        depth = std::max(depth, stage.depth);
    return depth;
}

// Each stage of each kind of ray once, in the order of their first generation.
std::vector<std::pair<std::string, std::string>> stages_of(const std::vector<KernelStage>& stages)
{
    std::vector<std::pair<std::string, std::string>> names;
    for (const char* rays : {"camera", "reflected", "refracted", "shadow", "hits"})
        for (const KernelStage& stage : stages)
            if (std::pair name(stage.rays, stage.name);
                stage.rays == rays && std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(std::move(name));
    return names;
}

double seconds_of(const KernelProfile& kernels, const std::pair<std::string, std::string>& name,
                  int depth)
{
    for (const KernelStage& stage : kernels.stages)
        if (stage.depth == depth && stage.rays == name.first && stage.name == name.second)
            return stage.seconds;
    return 0.0;
}

// The generations' columns: so many that lines stay short, the last with all further ones.
constexpr int depth_columns = 5;

void print_stages(std::ostream& to, const KernelProfile& kernels)
{
    const int depths = last_depth(kernels.stages) + 1;
    const int columns = std::min(depths, depth_columns);
    std::vector<std::string> head{"rays", "stage in the kernels", "ms", "share"};
    for (int depth = 0; depth < columns; ++depth)
        head.push_back("depth " + std::to_string(depth) +
                       (depth == columns - 1 && columns < depths ? " on" : ""));
    TextTable table(2, head);
    for (const auto& name : stages_of(kernels.stages)) {
        double sum = 0.0;
        std::vector<double> by_depth(static_cast<std::size_t>(columns));
        for (int depth = 0; depth < depths; ++depth) {
            const double seconds = seconds_of(kernels, name, depth);
            by_depth[static_cast<std::size_t>(std::min(depth, columns - 1))] += seconds;
            sum += seconds;
        }
        std::vector<std::string> row{name.first, name.second, milliseconds(sum),
                                     percent(sum, kernels.observed)};
        for (const double seconds : by_depth)
            row.push_back(seconds > 0.0 ? milliseconds(seconds) : "-");
        table.add(row);
    }
    const auto total = [&](const std::string& name, double seconds) {
        std::vector<std::string> row{name, "", milliseconds(seconds),
                                     percent(seconds, kernels.observed)};
        row.resize(head.size());
        table.add(row);
    };
    total("sum", sum_of(kernels.stages));
    total("frame", kernels.observed);
    table.print(to);
}

void print_rays(std::ostream& to, const KernelProfile& kernels)
{
    TextTable table(
        2, {"generation", "rays to their hits", "number", "ms", "share", "ns/ray", "Mrays/s"});
    for (const RayTime& row : kernels.rays) {
        const auto count = static_cast<double>(row.count);
        table.add({"depth " + std::to_string(row.depth), row.rays, std::to_string(row.count),
                   milliseconds(row.seconds), percent(row.seconds, kernels.observed),
                   fixed(1e9 * row.seconds / count, 2),
                   row.seconds > 0.0 ? fixed(1e-6 * count / row.seconds, 1) : "-"});
    }
    table.print(to);
}

void print_lanes(std::ostream& to, const Profile& profile)
{
    TextTable table(2, {"generation", "work of packets", "packets", "live lanes", "coherent"});
    for (const LaneUse& row : profile.kernels.lanes) {
        const auto packets = static_cast<double>(row.packets);
        table.add({"depth " + std::to_string(row.depth), row.work, std::to_string(row.packets),
                   percent(static_cast<double>(row.live), packets * profile.lanes),
                   row.coherent ? percent(static_cast<double>(*row.coherent), packets) : "-"});
    }
    table.print(to);
}

// Rays that tests are made for.
std::uint64_t rays_tested(const KernelProfile& kernels, const TestUse& test)
{
    std::uint64_t rays = 0;
    for (const RayTime& row : kernels.rays)
        if (row.depth == test.depth && (row.rays == "shadow") == (test.rays == "shadow"))
            rays += row.count;
    return rays;
}

void print_tests(std::ostream& to, const KernelProfile& kernels)
{
    TextTable table(3, {"generation", "rays", "tested", "together", "single", "single/ray"});
    for (const TestUse& row : kernels.tests)
        table.add({"depth " + std::to_string(row.depth), row.rays, row.tested,
                   std::to_string(row.tests), std::to_string(row.single),
                   ratio(row.single, rays_tested(kernels, row))});
    table.print(to);
}

}  // namespace

void print_kernels(std::ostream& to, const Profile& profile)
{
    const KernelProfile& kernels = profile.kernels;
    to << "inside the kernels, on one thread: frame " << milliseconds(kernels.plain)
       << " ms; by kernels that observe themselves " << milliseconds(kernels.observed)
       << " ms; with the clock, which gives the stages, " << milliseconds(kernels.clocked)
       << " ms (" << percent(kernels.clocked - kernels.observed, kernels.observed) << " more)\n\n";
    print_stages(to, kernels);
    to << '\n';
    print_rays(to, kernels);
    to << '\n';
    print_lanes(to, profile);
    to << '\n';
    print_tests(to, kernels);
}

nlohmann::ordered_json kernels_json(const KernelProfile& kernels)
{
    nlohmann::ordered_json json{{"plain_s", kernels.plain},
                                {"observed_s", kernels.observed},
                                {"clocked_s", kernels.clocked},
                                {"stages_sum_s", sum_of(kernels.stages)},
                                {"stages", nlohmann::ordered_json::array()},
                                {"rays", nlohmann::ordered_json::array()},
                                {"lanes", nlohmann::ordered_json::array()},
                                {"tests", nlohmann::ordered_json::array()}};
    for (const KernelStage& row : kernels.stages)
        json["stages"].push_back({{"depth", row.depth},
                                  {"rays", row.rays},
                                  {"name", row.name},
                                  {"seconds", row.seconds}});
    for (const RayTime& row : kernels.rays)
        json["rays"].push_back({{"depth", row.depth},
                                {"rays", row.rays},
                                {"count", row.count},
                                {"seconds", row.seconds}});
    for (const LaneUse& row : kernels.lanes)
        json["lanes"].push_back({{"depth", row.depth},
                                 {"work", row.work},
                                 {"packets", row.packets},
                                 {"live", row.live},
                                 {"coherent", row.coherent ? nlohmann::ordered_json(*row.coherent)
                                                           : nlohmann::ordered_json()}});
    for (const TestUse& row : kernels.tests)
        json["tests"].push_back({{"depth", row.depth},
                                 {"rays", row.rays},
                                 {"tested", row.tested},
                                 {"together", row.tests},
                                 {"single", row.single}});
    return json;
}

}  // namespace packtrace::cli
