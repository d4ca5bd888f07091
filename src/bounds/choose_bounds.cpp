#include "bounds/choose_bounds.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace packtrace::bounds {
namespace {

bool may_count(const HitInterval& hit, const Range& range)
{
    return hit.high > range.t_min && hit.low < range.t_max;
}

bool surely_counts(const HitInterval& hit, const Range& range)
{
    return hit.certain && hit.low > range.t_min && hit.high < range.t_max;
}

HitBounds rounded(Quad low, Quad high, const Range& range)
{
    return {std::max(round_down(low), range.t_min), std::min(round_up(high), range.t_max)};
}

/// An interval with all that overlap it.
HitBounds with_overlapping(const HitInterval& hit, std::span<const HitInterval> hits,
                           const Range& range)
{
    Quad low = hit.low;
    Quad high = hit.high;
    for (const HitInterval& more : hits)
        if (more.low <= high && more.high >= low) {
            low = std::min(low, more.low);
            high = std::max(high, more.high);
        }
    return rounded(low, high, range);
}

/// How far t is from an interval.
Quad distance(const HitInterval& hit, double t)
{
    return std::max({hit.low - t, t - hit.high, Quad(0)});
}

}  // namespace

HitBounds first_of(std::span<const HitInterval> hits, const Range& range)
{
    std::optional<Quad> low;
    std::optional<Quad> most;
    std::optional<Quad> latest;
    for (const HitInterval& hit : hits) {
        if (!may_count(hit, range))
            continue;
        low = low ? std::min(*low, hit.low) : hit.low;
        most = most ? std::max(*most, hit.high) : hit.high;
        // The first hit does not come after one that is there for sure.
        if (surely_counts(hit, range))
            latest = latest ? std::min(*latest, hit.high) : hit.high;
    }
    return low ? rounded(*low, latest.value_or(*most), range) : HitBounds{};
}

void bounds_of(std::span<const HitInterval> hits, const Range& range, std::span<const double> t,
               std::span<HitBounds> bounds)
{
    std::vector<HitInterval> counted;
    for (const HitInterval& hit : hits)
        if (may_count(hit, range))
            counted.insert(counted.end(), static_cast<std::size_t>(hit.hits), hit);
    for (std::size_t i = 0; i < t.size(); ++i) {
        if (counted.empty()) {
            bounds[i] = {};
            continue;
        }
        // As many as there can be: in their order. Else some are not there, and the nearest is it.
        const HitInterval hit =
            counted.size() == t.size()
                ? counted[i]
                : *std::min_element(counted.begin(), counted.end(),
                                    [&](const HitInterval& a, const HitInterval& b) {
                                        return distance(a, t[i]) < distance(b, t[i]);
                                    });
        bounds[i] = with_overlapping(hit, counted, range);
    }
}

}  // namespace packtrace::bounds
