#include "lab/profile/work_rows.hpp"

#include <cstddef>

namespace packtrace {
namespace {

constexpr const char* work_names[] = {"closest hits", "shadow rays", "local light",
                                      "highlight powers", "child rays"};
static_assert(std::size(work_names) == abi::packet_work_count);

constexpr const char* primitive_names[] = {"spheres", "anchored spheres", "planes", "quadrics",
                                           "polygons"};
static_assert(std::size(primitive_names) == abi::primitive_count);

constexpr const char* purpose_names[] = {"closest", "shadow"};
static_assert(std::size(purpose_names) == abi::purpose_count);

const abi::PacketCounts& packets_of(const abi::WorkCounts& counts, abi::PacketWork work)
{
    return counts.work[static_cast<int>(work)];
}

bool has_result(int work)
{
    return work == static_cast<int>(abi::PacketWork::trace) ||
           work == static_cast<int>(abi::PacketWork::shadow);
}

}  // namespace

std::vector<LaneUse> lane_rows(const std::vector<abi::WorkCounts>& counts)
{
    std::vector<LaneUse> rows;
    for (std::size_t depth = 0; depth < counts.size(); ++depth)
        for (int work = 0; work < abi::packet_work_count; ++work) {
            const abi::PacketCounts& packets = counts[depth].work[work];
            if (packets.packets == 0)
                continue;
            LaneUse row{static_cast<int>(depth), work_names[work], packets.packets, packets.live,
                        std::nullopt};
            if (has_result(work))
                row.coherent = packets.coherent;
            rows.push_back(row);
        }
    return rows;
}

std::vector<TestUse> test_rows(const std::vector<abi::WorkCounts>& counts)
{
    std::vector<TestUse> rows;
    for (std::size_t depth = 0; depth < counts.size(); ++depth)
        for (int purpose = 0; purpose < abi::purpose_count; ++purpose) {
            const abi::WorkCounts& at = counts[depth];
            const auto add = [&](const char* tested, std::uint64_t tests, std::uint64_t single) {
                if (tests + single > 0)
                    rows.push_back(
                        {static_cast<int>(depth), purpose_names[purpose], tested, tests, single});
            };
            add("nodes", at.group_nodes[purpose], at.ray_nodes[purpose]);
            for (int kind = 0; kind < abi::primitive_count; ++kind)
                add(primitive_names[kind], at.tests[purpose][kind].packets,
                    at.tests[purpose][kind].pairs);
        }
    return rows;
}

std::vector<RayTime> ray_rows(const std::vector<abi::WorkCounts>& counts,
                              const std::vector<KernelStage>& stages)
{
    std::vector<RayTime> rows;
    const auto add = [&](std::size_t depth, const char* rays, std::uint64_t count) {
        RayTime row{static_cast<int>(depth), rays, count, 0.0};
        for (const KernelStage& stage : stages)
            if (stage.depth == row.depth && stage.rays == rays)
                row.seconds += stage.seconds;
        if (count > 0)
            rows.push_back(row);
    };
    for (std::size_t depth = 0; depth < counts.size(); ++depth) {
        const abi::WorkCounts& at = counts[depth];
        const std::uint64_t traced = packets_of(at, abi::PacketWork::trace).live;
        add(depth, "camera", depth == 0 ? traced + at.untraced : 0);
        add(depth, "reflected", depth == 0 ? 0 : traced - at.refracted);
        add(depth, "refracted", at.refracted);
        add(depth, "shadow", packets_of(at, abi::PacketWork::shadow).live);
    }
    return rows;
}

std::optional<double> lanes_filled(const abi::WorkCounts& counts, int lanes)
{
    const abi::PacketCounts& packets = packets_of(counts, abi::PacketWork::trace);
    if (packets.packets == 0)
        return std::nullopt;
    return static_cast<double>(packets.live) /
           (static_cast<double>(packets.packets) * static_cast<double>(lanes));
}

const std::vector<std::string>& unsure_causes()
{
    static const std::vector<std::string> names{"tangent", "order", "range", "clip", "magnitude"};
    static_assert(abi::cause_count == 5);
    return names;
}

void add_causes(const abi::WorkCounts& counts, UnsureCounts& sum)
{
    for (const auto& by_cause : counts.unsure)
        for (std::size_t cause = 0; cause < abi::cause_count; ++cause)
            sum[cause] += by_cause[cause];
}

std::vector<UnsureUse> unsure_rows(const std::vector<abi::WorkCounts>& counts)
{
    std::vector<UnsureUse> rows;
    for (std::size_t depth = 0; depth < counts.size(); ++depth)
        for (std::size_t purpose = 0; purpose < abi::purpose_count; ++purpose)
            for (std::size_t cause = 0; cause < abi::cause_count; ++cause)
                if (const std::uint64_t count = counts[depth].unsure[purpose][cause]; count > 0)
                    rows.push_back({static_cast<int>(depth), purpose_names[purpose],
                                    unsure_causes()[cause], count});
    return rows;
}

}  // namespace packtrace
