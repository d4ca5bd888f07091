#include "lab/profile/span_times.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

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
    readings_.push_back(
        {observation_.end, std::chrono::duration<double>(Clock::now() - start_).count()});
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

}  // namespace packtrace
