#include "lab/profile/stage_times.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "core/seconds_since.hpp"
#include "lab/harness/statistics.hpp"

namespace packtrace {
namespace {

SpanTicks span_ticks(const abi::SpanLaps& laps)
{
    SpanTicks result;
    for (int i = 0; i < abi::span_count; ++i)
        result.span[static_cast<std::size_t>(i)] = static_cast<double>(laps.span[i]);
    const double traced = result.span[static_cast<std::size_t>(abi::Span::trace)];
    result.refracted = traced > 0.0 ? laps.refracted / traced : 0.0;
    return result;
}

double total_of(const std::vector<SpanTicks>& generations)
{
    double sum = 0.0;
    for (const SpanTicks& generation : generations)
        sum += generation.total();
    return sum;
}

}  // namespace

double SpanTicks::total() const
{
    return std::accumulate(span.begin(), span.end(), 0.0);
}

SpanTimes::SpanTimes(int pieces, int generations)
    : laps_(static_cast<std::size_t>(generations)), of_piece_(static_cast<std::size_t>(pieces))
{
    observation_.generations = generations;
    observation_.spans = laps_.data();
}

abi::Observation* SpanTimes::begin()
{
    std::fill(laps_.begin(), laps_.end(), abi::SpanLaps{});
    return &observation_;
}

void SpanTimes::end(int piece)
{
    readings_.push_back({observation_.end, seconds_since(start_)});
    std::vector<SpanTicks> generations;
    for (const abi::SpanLaps& laps : laps_)
        generations.push_back(span_ticks(laps));
    of_piece_[static_cast<std::size_t>(piece)].push_back(std::move(generations));
}

std::vector<SpanTicks> SpanTimes::seconds(int piece) const
{
    auto times = of_piece_[static_cast<std::size_t>(piece)];
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end(),
                     [](const auto& a, const auto& b) { return total_of(a) < total_of(b); });
    std::vector<SpanTicks> result = *middle;
    const double seconds = seconds_of_tick(readings_);
    for (SpanTicks& generation : result)
        for (double& span : generation.span)
            span *= seconds;
    return result;
}

double seconds_of_tick(const std::vector<ClockReading>& readings)
{
    const std::size_t half = readings.size() / 2;
    std::vector<double> slopes;
    for (std::size_t i = 0; i + half < readings.size(); ++i) {
        const ClockReading& from = readings[i];
        const ClockReading& to = readings[i + half];
        if (to.tick > from.tick)
            slopes.push_back((to.seconds - from.seconds) /
                             static_cast<double>(to.tick - from.tick));
    }
    return slopes.empty() ? 0.0 : median_of(slopes);
}

namespace {

// Whose work it is, in the order of printing.
enum Rays : std::size_t { camera, reflected, refracted, shadow, hits, rays_count };

constexpr const char* rays_names[] = {"camera", "reflected", "refracted", "shadow", "hits"};

constexpr const char* part_names[] = {
    "cones and what they may meet",
    "ray generation",
    "traversal of boxes",
    "spheres",
    "anchored spheres",
    "planes",
    "quadrics",
    "polygons",
    "unsure rays again in double",
    "compaction of hits",
    "normals and materials",
    "diffuse light",
    "highlight powers",
    "child rays",
    "pixels",
};
static_assert(std::size(part_names) == abi::part_count);

// Whose a span is that is not traced for secondary rays.
Rays rays_of(abi::Span span, abi::Role role)
{
    if (role == abi::Role::shadow || span == abi::Span::shadows)
        return shadow;
    return span == abi::Span::setup || span == abi::Span::trace ? camera : hits;
}

// Ticks of a reading of the clock taken off for each: it waits, so that all of them are its own.
double without_readings(const abi::Lap& lap, std::uint64_t reading)
{
    return std::max(0.0, static_cast<double>(lap.ticks) - static_cast<double>(lap.reads * reading));
}

double total_of(const abi::PartLaps& laps, int span, std::uint64_t reading)
{
    double sum = 0.0;
    for (const auto& role : laps.part[span])
        for (const abi::Lap& lap : role)
            sum += without_readings(lap, reading);
    return sum;
}

}  // namespace

StageSeconds::StageSeconds(int generations) : generations_(static_cast<std::size_t>(generations))
{
}

void StageSeconds::add(const std::vector<SpanTicks>& spans, const std::vector<abi::PartLaps>& parts,
                       std::uint64_t reading)
{
    for (std::size_t depth = 0; depth < generations_.size(); ++depth)
        for (int span = 0; span < abi::span_count; ++span) {
            // A span too short for its clock is divided as it was read.
            const bool is_clocked = total_of(parts[depth], span, reading) > 0.0;
            const std::uint64_t taken_off = is_clocked ? reading : 0;
            const double total = total_of(parts[depth], span, taken_off);
            if (total <= 0.0)
                continue;
            const double scale = spans[depth].span[static_cast<std::size_t>(span)] / total;
            for (int role = 0; role < abi::role_count; ++role)
                for (int part = 0; part < abi::part_count; ++part)
                    add_part(
                        depth, rays_of(static_cast<abi::Span>(span), static_cast<abi::Role>(role)),
                        static_cast<std::size_t>(part), spans[depth].refracted,
                        scale * without_readings(parts[depth].part[span][role][part], taken_off));
        }
}

// Tracing after the first generation is for reflected and refracted rays.
void StageSeconds::add_part(std::size_t depth, std::size_t rays, std::size_t part,
                            double refracted_share, double seconds)
{
    if (rays != camera || depth == 0) {
        generations_[depth][rays][part] += seconds;
        return;
    }
    generations_[depth][refracted][part] += seconds * refracted_share;
    generations_[depth][reflected][part] += seconds * (1.0 - refracted_share);
}

std::vector<KernelStage> StageSeconds::stages() const
{
    std::vector<KernelStage> result;
    for (std::size_t depth = 0; depth < generations_.size(); ++depth)
        for (std::size_t rays = 0; rays < rays_count; ++rays)
            for (std::size_t part = 0; part < abi::part_count; ++part)
                if (const double seconds = generations_[depth][rays][part]; seconds > 0.0)
                    result.push_back(
                        {static_cast<int>(depth), rays_names[rays], part_names[part], seconds});
    return result;
}

}  // namespace packtrace
