#include "mpi/job_report.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include <nlohmann/json.hpp>

#include "core/json_text.hpp"
#include "scene/quote.hpp"

namespace packtrace::mpi {
namespace {

nlohmann::ordered_json report_json(const std::string& output, const std::string& what,
                                   const std::vector<RankReport>& reports,
                                   const std::vector<std::string>& hosts, double seconds)
{
    nlohmann::ordered_json json{{"output", output}, {"seconds", seconds}, {"pieces", what}};
    json["ranks"] = nlohmann::ordered_json::array();
    for (std::size_t rank = 0; rank < reports.size(); ++rank) {
        const RankReport& report = reports[rank];
        json["ranks"].push_back({{"rank", rank},
                                 {"host", hosts[rank]},
                                 {"pieces", report.pieces},
                                 {"rays", report.rays},
                                 {"busy_seconds", report.busy},
                                 {"waiting_seconds", report.waiting},
                                 {"bytes_sent", report.bytes_sent}});
    }
    return json;
}

}  // namespace

void add_job_options(CLI::App& command, JobArguments& arguments)
{
    command.add_flag("--allow-mixed", arguments.allow_mixed,
                     "Let ranks with and without fused multiply-add work on one result, whose bits "
                     "then depend on who made them");
    command.add_flag("--json", arguments.json,
                     "Print JSON: rays, busy and waiting seconds of each rank");
}

void print_report(const World& world, const JobArguments& arguments, bool quiet,
                  const std::string& output, const std::string& what,
                  const std::vector<RankReport>& reports, double seconds)
{
    const std::vector<std::string> hosts = world.gather(world.host());
    if (!world.is_first())
        return;
    if (arguments.json)
        std::cout << json_text(report_json(output, what, reports, hosts, seconds)) << std::flush;
    if (quiet || arguments.json)
        return;
    std::int64_t pieces = 0;
    double waiting = 0.0;
    for (const RankReport& report : reports) {
        pieces += report.pieces;
        waiting = std::max(waiting, report.waiting);
    }
    char times[96];
    std::snprintf(times, sizeof times, " in %.1f s; no rank waited longer than %.1f s\n", seconds,
                  waiting);
    std::cerr << language::escape(output) << ": " << pieces << ' ' << what << " on "
              << reports.size() << " ranks" << times;
}

}  // namespace packtrace::mpi
