#include "cli/study/profile_kernels.hpp"

namespace packtrace::cli {

double sum_of(const std::vector<KernelStage>& stages)
{
    double sum = 0.0;
    for (const KernelStage& stage : stages)
        sum += stage.seconds;
    return sum;
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
