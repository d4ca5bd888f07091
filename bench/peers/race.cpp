#include "race.hpp"

#include "lab/harness/statistics.hpp"

#include <algorithm>

namespace packtrace::peers {
namespace {

struct Entry {
    const Tracer* tracer;
    const Heat* heat;
};

}  // namespace

double Result::median_rate() const
{
    return 1e-6 * rays / median_of(seconds);
}

double Result::lowest_rate() const
{
    return 1e-6 * rays / *std::max_element(seconds.begin(), seconds.end());
}

double Result::highest_rate() const
{
    return 1e-6 * rays / *std::min_element(seconds.begin(), seconds.end());
}

std::vector<Result> race(const std::vector<Heat>& heats, const std::vector<Tracer>& tracers,
                         HeatKind kind, int passes)
{
    std::vector<Entry> entries;
    std::vector<Result> results;
    for (const Heat& heat : heats)
        for (const Tracer& tracer : tracers) {
            if (tracer.camera_only && kind != HeatKind::camera)
                continue;
            entries.push_back({&tracer, &heat});
            Result& result = results.emplace_back();
            result.tracer = tracer.name;
            result.end = heat.end;
            result.side = tracer.side;
            result.own_rays = tracer.camera_only;
            result.rays = static_cast<double>(heat.rays.size());
            result.hits = Hits(heat.rays.size());
        }
    for (int pass = -1; pass < passes; ++pass)
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const Heat& heat = *entries[i].heat;
            const double seconds = entries[i].tracer->trace(heat.rays, heat.query, results[i].hits);
            if (pass >= 0)
                results[i].seconds.push_back(seconds);
        }
    return results;
}

const Result* best_of(const std::vector<Result>& results, Side side)
{
    const Result* best = nullptr;
    for (const Result& result : results)
        if (result.side == side && (best == nullptr || result.median_rate() > best->median_rate()))
            best = &result;
    return best;
}

double median_ratio(const Result& result, const Result& other)
{
    std::vector<double> ratios;
    for (std::size_t pass = 0; pass < result.seconds.size(); ++pass)
        ratios.push_back(other.seconds[pass] / result.seconds[pass]);
    return median_of(ratios);
}

}  // namespace packtrace::peers
