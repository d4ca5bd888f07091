#include "cli/output/text_table.hpp"
#include "cli/study/profile_print.hpp"
#include "lab/harness/statistics.hpp"

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

namespace packtrace::cli {
namespace {

/// The number of generations in tables. The last of them includes all deeper generations.
constexpr int depths_shown = 5;

/// `deepest` is the largest depth of all rows.
std::string depth_name(int depth, int deepest)
{
    const bool more = depth == depths_shown - 1 && deepest > depth;
    return "depth " + std::to_string(depth) + (more ? " on" : "");
}

template <class Row>
int deepest_of(const std::vector<Row>& rows)
{
    int depth = 0;
    for (const Row& row : rows)
        depth = std::max(depth, row.depth);
    return depth;
}

/// Joins the rows of generations that are not shown separately: `add(to, row)` adds a row to
/// another if `same` is true for them.
template <class Row, class Same, class Add>
std::vector<Row> with_deep_ones_joined(const std::vector<Row>& rows, const Same& same,
                                       const Add& add)
{
    std::vector<Row> joined;
    for (Row row : rows) {
        row.depth = std::min(row.depth, depths_shown - 1);
        const auto found = std::find_if(joined.begin(), joined.end(), [&](const Row& other) {
            return other.depth == row.depth && same(other, row);
        });
        if (found == joined.end())
            joined.push_back(row);
        else
            add(*found, row);
    }
    return joined;
}

std::string ratio(std::uint64_t part, std::uint64_t whole)
{
    return whole > 0 ? fixed(static_cast<double>(part) / static_cast<double>(whole), 2) : "-";
}

// The kinds of rays in the table of stages, in its order.
constexpr const char* ray_kinds[] = {"camera", "reflected", "refracted", "shadow", "hits"};

// A stage of one kind of rays in all generations.
struct StageRow {
    std::string rays;
    std::string name;
    double seconds = 0.0;
    double by_depth[depths_shown] = {};
};

std::vector<StageRow> stage_rows(const std::vector<KernelStage>& stages)
{
    std::vector<StageRow> rows;
    for (const char* rays : ray_kinds)
        for (const KernelStage& stage : stages) {
            if (stage.rays != rays)
                continue;
            auto row = std::find_if(rows.begin(), rows.end(), [&](const StageRow& other) {
                return other.rays == stage.rays && other.name == stage.name;
            });
            if (row == rows.end())
                row = rows.insert(row, {stage.rays, stage.name});
            row->seconds += stage.seconds;
            row->by_depth[std::min(stage.depth, depths_shown - 1)] += stage.seconds;
        }
    return rows;
}

void print_stages(std::ostream& to, const KernelProfile& kernels)
{
    const int deepest = deepest_of(kernels.stages);
    const int columns = std::min(deepest + 1, depths_shown);
    std::vector<std::string> head{"rays", "stage in the kernels", "ms", "share"};
    for (int depth = 0; depth < columns; ++depth)
        head.push_back(depth_name(depth, deepest));
    TextTable table(2, head);
    for (const StageRow& stage : stage_rows(kernels.stages)) {
        std::vector<std::string> row{stage.rays, stage.name, milliseconds(stage.seconds),
                                     percent(stage.seconds, kernels.observed)};
        for (int depth = 0; depth < columns; ++depth)
            row.push_back(stage.by_depth[depth] > 0.0 ? milliseconds(stage.by_depth[depth]) : "-");
        table.add(row);
    }
    const auto total = [&](const std::string& name, double seconds) {
        std::vector<std::string> row{name, "", milliseconds(seconds),
                                     percent(seconds, kernels.observed)};
        row.resize(head.size());
        table.add(row);
    };
    total("sum", sum_of_seconds(kernels.stages));
    total("frame", kernels.observed);
    table.print(to);
}

void print_rays(std::ostream& to, const KernelProfile& kernels)
{
    TextTable table(
        2, {"generation", "rays to their hits", "number", "ms", "share", "ns/ray", "Mrays/s"});
    const auto rows = with_deep_ones_joined(
        kernels.rays, [](const RayTime& a, const RayTime& b) { return a.rays == b.rays; },
        [](RayTime& sum, const RayTime& row) {
            sum.count += row.count;
            sum.seconds += row.seconds;
        });
    for (const RayTime& row : rows) {
        const auto count = static_cast<double>(row.count);
        table.add({depth_name(row.depth, deepest_of(kernels.rays)), row.rays,
                   std::to_string(row.count), milliseconds(row.seconds),
                   percent(row.seconds, kernels.observed), fixed(1e9 * row.seconds / count, 2),
                   row.seconds > 0.0 ? fixed(1e-6 * count / row.seconds, 1) : "-"});
    }
    table.print(to);
}

void print_lanes(std::ostream& to, const Profile& profile)
{
    const std::vector<LaneUse>& lanes = profile.kernels.lanes;
    TextTable table(2, {"generation", "work of packets", "packets", "live lanes", "coherent"});
    const auto rows = with_deep_ones_joined(
        lanes, [](const LaneUse& a, const LaneUse& b) { return a.work == b.work; },
        [](LaneUse& sum, const LaneUse& row) {
            sum.packets += row.packets;
            sum.live += row.live;
            if (sum.coherent && row.coherent)
                *sum.coherent += *row.coherent;
        });
    for (const LaneUse& row : rows) {
        const auto packets = static_cast<double>(row.packets);
        table.add({depth_name(row.depth, deepest_of(lanes)), row.work, std::to_string(row.packets),
                   percent(static_cast<double>(row.live), packets * profile.lanes),
                   row.coherent ? percent(static_cast<double>(*row.coherent), packets) : "-"});
    }
    table.print(to);
}

// The rays with the kind and the generation of a row.
template <class Row>
std::uint64_t rays_tested(const KernelProfile& kernels, const Row& test)
{
    std::uint64_t rays = 0;
    for (const RayTime& row : kernels.rays)
        if (std::min(row.depth, depths_shown - 1) == test.depth &&
            (row.rays == "shadow") == (test.rays == "shadow"))
            rays += row.count;
    return rays;
}

void print_tests(std::ostream& to, const KernelProfile& kernels)
{
    TextTable table(3, {"generation", "rays", "tested", "together", "single", "single/ray"});
    const auto rows = with_deep_ones_joined(
        kernels.tests,
        [](const TestUse& a, const TestUse& b) { return a.rays == b.rays && a.tested == b.tested; },
        [](TestUse& sum, const TestUse& row) {
            sum.tests += row.tests;
            sum.single += row.single;
        });
    for (const TestUse& row : rows)
        table.add({depth_name(row.depth, deepest_of(kernels.tests)), row.rays, row.tested,
                   std::to_string(row.tests), std::to_string(row.single),
                   ratio(row.single, rays_tested(kernels, row))});
    table.print(to);
}

// Prints nothing if no ray is unsure.
void print_unsure(std::ostream& to, const KernelProfile& kernels)
{
    if (kernels.unsure.empty())
        return;
    TextTable table(3, {"generation", "rays", "unsure for", "number", "share"});
    const auto rows = with_deep_ones_joined(
        kernels.unsure,
        [](const UnsureUse& a, const UnsureUse& b) {
            return a.rays == b.rays && a.cause == b.cause;
        },
        [](UnsureUse& sum, const UnsureUse& row) { sum.count += row.count; });
    for (const UnsureUse& row : rows)
        table.add({depth_name(row.depth, deepest_of(kernels.unsure)), row.rays, row.cause,
                   std::to_string(row.count),
                   fixed(100.0 * static_cast<double>(row.count) /
                             static_cast<double>(rays_tested(kernels, row)),
                         4) +
                       " %"});
    to << '\n';
    table.print(to);
}

}  // namespace

void print_kernels(std::ostream& to, const Profile& profile)
{
    const KernelProfile& kernels = profile.kernels;
    to << "inside the kernels, on one thread: frame " << milliseconds(kernels.plain)
       << " ms; by kernels that observe themselves " << milliseconds(kernels.observed) << " ms,\n"
       << "with the clock that gives the stages " << milliseconds(kernels.clocked)
       << " ms, which is "
       << percent(std::max(0.0, kernels.clocked - kernels.observed), kernels.observed)
       << " more\n\n";
    print_stages(to, kernels);
    to << '\n';
    print_rays(to, kernels);
    to << '\n';
    print_lanes(to, profile);
    to << '\n';
    print_tests(to, kernels);
    print_unsure(to, kernels);
}

nlohmann::ordered_json kernels_json(const KernelProfile& kernels)
{
    nlohmann::ordered_json json{{"plain_s", kernels.plain},
                                {"observed_s", kernels.observed},
                                {"clocked_s", kernels.clocked},
                                {"stages_sum_s", sum_of_seconds(kernels.stages)},
                                {"stages", nlohmann::ordered_json::array()},
                                {"rays", nlohmann::ordered_json::array()},
                                {"lanes", nlohmann::ordered_json::array()},
                                {"tests", nlohmann::ordered_json::array()},
                                {"unsure", nlohmann::ordered_json::array()}};
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
    for (const UnsureUse& row : kernels.unsure)
        json["unsure"].push_back(
            {{"depth", row.depth}, {"rays", row.rays}, {"cause", row.cause}, {"count", row.count}});
    return json;
}

}  // namespace packtrace::cli
