#include "bounds/bounded_scene.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include <tbb/concurrent_vector.h>

#include "core/in_parallel.hpp"

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

/// Bounds of the first hit in the range, from line_hits(); empty where there surely is none.
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

/// Bounds of each of several hits in the range, whose rounded t are given in rising order.
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

}  // namespace

BoundedScene::BoundedScene(const Scene& scene)
{
    index_.reserve(scene.objects.size());
    for (const Object& object : scene.objects) {
        if (is_plain_sphere(object)) {
            index_.push_back(static_cast<std::int32_t>(spheres_.size()));
            spheres_.push_back(std::get<Sphere>(object.surface));
        } else {
            index_.push_back(~static_cast<std::int32_t>(placed_.size()));
            placed_.push_back({object.surface, object.transform});
        }
    }
}

bool BoundedScene::holds(std::int32_t object, const Object& now) const
{
    const std::int32_t at = index_[static_cast<std::size_t>(object)];
    if (at >= 0)
        return is_plain_sphere(now) &&
               spheres_[static_cast<std::size_t>(at)] == std::get<Sphere>(now.surface);
    const Placed& placed = placed_[static_cast<std::size_t>(~at)];
    return placed.transform == now.transform && placed.surface == now.surface;
}

bool BoundedScene::replace_in_place(const Scene& scene, const MovedShape& shape)
{
    const std::int32_t at = index_[static_cast<std::size_t>(shape.object)];
    if (at >= 0 && !shape.plain)
        return false;
    if (at >= 0) {
        spheres_[static_cast<std::size_t>(at)] = shape.sphere;
    } else {
        const Object& now = scene.objects[static_cast<std::size_t>(shape.object)];
        placed_[static_cast<std::size_t>(~at)] = {now.surface, now.transform};
    }
    return true;
}

void BoundedScene::replace(const Scene& scene, std::span<const MovedShape> moved)
{
    tbb::concurrent_vector<std::int32_t> placed_now;
    for_each_in_parallel(moved, [&](const MovedShape& shape) {
        if (!replace_in_place(scene, shape))
            placed_now.push_back(shape.object);
    });
    for (const std::int32_t object : placed_now) {
        const Object& now = scene.objects[static_cast<std::size_t>(object)];
        index_[static_cast<std::size_t>(object)] = ~static_cast<std::int32_t>(placed_.size());
        placed_.push_back({now.surface, now.transform});
    }
}

std::vector<HitInterval> BoundedScene::hits_of(std::int32_t object, const Line& line) const
{
    const std::int32_t at = index_[static_cast<std::size_t>(object)];
    if (at >= 0)
        return line_hits(spheres_[static_cast<std::size_t>(at)], Mat4(1.0), line);
    const Placed& placed = placed_[static_cast<std::size_t>(~at)];
    return line_hits(placed.surface, placed.transform, line);
}

HitBounds BoundedScene::first_hit(std::int32_t object, const Line& line, const Range& range) const
{
    return first_of(hits_of(object, line), range);
}

void BoundedScene::all_hits(std::int32_t object, const Line& line, const Range& range,
                            std::span<const double> t, std::span<HitBounds> bounds) const
{
    bounds_of(hits_of(object, line), range, t, bounds);
}

}  // namespace packtrace::bounds
