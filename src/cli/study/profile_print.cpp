#include "cli/study/profile_print.hpp"

#include "cli/output/text_table.hpp"
#include "lab/harness/statistics.hpp"

#include <ostream>

namespace packtrace::cli {
namespace {

// Empty without rays.
std::string nanoseconds_per_ray(double seconds, std::uint64_t rays)
{
    return rays > 0 ? fixed(1e9 * seconds / static_cast<double>(rays), 2) : "-";
}

void print_stages(std::ostream& to, const Profile& profile)
{
    TextTable table(1, {"stage", "ms", "share"});
    for (const ProfileStage& stage : profile.stages)
        table.add({stage.name, milliseconds(stage.seconds), percent(stage.seconds, profile.whole)});
    table.add({"sum", milliseconds(sum_of_seconds(profile.stages)),
               percent(sum_of_seconds(profile.stages), profile.whole)});
    table.add({"scene's text to file's bytes, at once", milliseconds(profile.whole), "100.0 %"});
    table.print(to);
}

void print_first_frame(std::ostream& to, const Profile& profile)
{
    TextTable table(1, {"in a new process", "ms", "of a warm frame", "page faults"});
    for (const FirstFrameStep& step : profile.first_frame)
        table.add({step.name, milliseconds(step.seconds), percent(step.seconds, profile.frame),
                   std::to_string(step.page_faults)});
    table.print(to);
}

void print_generations(std::ostream& to, const Profile& profile)
{
    TextTable table(1, {"generation", "camera", "shadow", "reflected", "refracted", "ms", "share",
                        "ns/ray", "lanes filled"});
    for (const ProfileGeneration& generation : profile.generations) {
        const FrameCounts& rays = generation.rays;
        table.add({"depth " + std::to_string(generation.depth), std::to_string(rays.camera),
                   std::to_string(rays.shadow), std::to_string(rays.reflected),
                   std::to_string(rays.refracted), milliseconds(generation.seconds),
                   percent(generation.seconds, profile.frame),
                   nanoseconds_per_ray(generation.seconds, rays.total()),
                   generation.lanes_filled ? percent(*generation.lanes_filled, 1.0) : "-"});
    }
    table.print(to);
}

void print_what_if(std::ostream& to, const Profile& profile)
{
    TextTable table(1, {"the same frame", "ms", "saves", "costs", "share"});
    for (const ProfileWhatIf& row : profile.what_if) {
        const std::string difference = milliseconds(row.difference);
        table.add({row.name, milliseconds(row.seconds), row.does_more ? "-" : difference,
                   row.does_more ? difference : "-", percent(row.difference, profile.frame)});
    }
    table.print(to);
}

// Printed above all figures, so that it is read first.
void print_too_busy(std::ostream& to, const Profile& profile)
{
    if (profile.too_busy.empty())
        return;
    to << "The machine is too busy for some of these figures; measure again on an idle one:\n";
    for (const std::string& line : profile.too_busy)
        to << "- " << line << '\n';
    to << '\n';
}

nlohmann::ordered_json rays_json(const FrameCounts& rays)
{
    return {{"camera", rays.camera},
            {"shadow", rays.shadow},
            {"reflected", rays.reflected},
            {"refracted", rays.refracted}};
}

using Json = nlohmann::ordered_json;

/// The list of `json_of(item)` for all items.
template <class Items, class JsonOf>
Json list_json(const Items& items, const JsonOf& json_of)
{
    Json list = Json::array();
    for (const auto& item : items)
        list.push_back(json_of(item));
    return list;
}

Json step_json(const FirstFrameStep& step)
{
    return {{"name", step.name}, {"seconds", step.seconds}, {"page_faults", step.page_faults}};
}

Json stage_json(const ProfileStage& stage)
{
    return {{"name", stage.name}, {"seconds", stage.seconds}};
}

Json generation_json(const ProfileGeneration& generation)
{
    return {{"depth", generation.depth},
            {"rays", rays_json(generation.rays)},
            {"seconds", generation.seconds},
            {"spread_s", generation.spread},
            {"lanes_filled", generation.lanes_filled ? Json(*generation.lanes_filled) : Json()}};
}

Json what_if_json(const ProfileWhatIf& row)
{
    return {{"name", row.name},
            {"seconds", row.seconds},
            {row.does_more ? "costs" : "saves", row.difference},
            {"spread_s", row.spread},
            {"rays", rays_json(row.rays)}};
}

}  // namespace

void print_profile(std::ostream& to, const std::string& scene, const Profile& profile)
{
    const auto rays = static_cast<double>(profile.rays.total());
    to << scene << ": " << profile.width << " x " << profile.height << ", " << profile.isa << ", "
       << profile.lanes << " lanes, threads: " << profile.threads << '\n'
       << "frame " << milliseconds(profile.frame) << " ms (spread "
       << fixed(100.0 * profile.frame_spread, 1) << " %), " << profile.rays.total() << " rays, "
       << fixed(1e9 * profile.frame / rays, 2) << " ns a ray, "
       << fixed(1e-6 * rays / profile.frame, 1) << " Mrays/s\n\n";
    print_too_busy(to, profile);
    print_stages(to, profile);
    to << '\n';
    print_first_frame(to, profile);
    to << '\n';
    if (!profile.generations.empty()) {
        print_generations(to, profile);
        to << '\n';
    }
    print_kernels(to, profile);
    to << '\n';
    print_what_if(to, profile);
}

nlohmann::ordered_json profile_json(const std::string& scene, const Profile& profile)
{
    return {{"packtrace_profile", 1},
            {"scene", scene},
            {"width", profile.width},
            {"height", profile.height},
            {"isa", profile.isa},
            {"lanes", profile.lanes},
            {"threads", profile.threads},
            {"frame_s", profile.frame},
            {"frame_spread", profile.frame_spread},
            {"whole_s", profile.whole},
            {"too_busy", profile.too_busy},
            {"rays", rays_json(profile.rays)},
            {"first_frame", list_json(profile.first_frame, step_json)},
            {"stages", list_json(profile.stages, stage_json)},
            {"generations", list_json(profile.generations, generation_json)},
            {"what_if", list_json(profile.what_if, what_if_json)},
            {"kernels", kernels_json(profile.kernels)}};
}

nlohmann::ordered_json trace_json(const std::vector<TileSpan>& tiles)
{
    nlohmann::ordered_json events = nlohmann::ordered_json::array();
    for (const TileSpan& tile : tiles)
        events.push_back({{"name", "tile " + std::to_string(tile.x) + "," + std::to_string(tile.y)},
                          {"cat", "tile"},
                          {"ph", "X"},
                          {"pid", 1},
                          {"tid", tile.thread},
                          {"ts", 1e6 * tile.start},
                          {"dur", 1e6 * tile.seconds},
                          {"args", {{"rays", tile.rays}}}});
    return {{"traceEvents", events}, {"displayTimeUnit", "ns"}};
}

}  // namespace packtrace::cli
