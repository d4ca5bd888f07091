#include "bounds/bounded_scene.hpp"

#include "core/in_parallel.hpp"

#include <tbb/concurrent_vector.h>

#include <algorithm>
#include <optional>
#include <variant>

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

/// The bounds of an interval and of all that overlap it.
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

/// The distance of t from an interval; 0 inside it.
Quad distance(const HitInterval& hit, double t)
{
    return std::max({hit.low - t, t - hit.high, Quad(0)});
}

/// Bounds of the first hit in the range, by line_hits(); empty where no hit can be there.
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
        // The first hit does not come after a certain one.
        if (surely_counts(hit, range))
            latest = latest ? std::min(*latest, hit.high) : hit.high;
    }
    return low ? rounded(*low, latest.value_or(*most), range) : HitBounds{};
}

/// The cost of assigning hits to intervals. Fewer passed over is better; then a smaller distance.
struct Misfit {
    int passed_over = 0;  ///< certain intervals without an assigned hit
    Quad distance = 0;    ///< of the hits from their intervals, summed

    friend bool operator<(const Misfit& a, const Misfit& b)
    {
        return a.passed_over != b.passed_over ? a.passed_over < b.passed_over
                                              : a.distance < b.distance;
    }
};

/// Assigns each t to one of `hits`, in rising order, at the least Misfit. There are at least as
/// many intervals as t. By dynamic programming.
std::vector<std::size_t> in_order(std::span<const HitInterval> hits, std::span<const double> t)
{
    const std::size_t width = hits.size() + 1;
    // The least misfit of the first `i` of t in the first `j` intervals, for j >= i.
    std::vector<Misfit> best((t.size() + 1) * width);
    std::vector<bool> takes(best.size());
    for (std::size_t i = 0; i <= t.size(); ++i)
        for (std::size_t j = std::max<std::size_t>(i, 1); j <= hits.size(); ++j) {
            const std::size_t at = i * width + j;
            const HitInterval& hit = hits[j - 1];
            Misfit without = best[at - 1];
            without.passed_over += hit.certain ? 1 : 0;
            Misfit with = i > 0 ? best[at - width - 1] : Misfit{};
            with.distance += i > 0 ? distance(hit, t[i - 1]) : Quad(0);
            takes[at] = i > 0 && (i == j || with < without);
            best[at] = takes[at] ? with : without;
        }
    std::vector<std::size_t> found(t.size());
    for (std::size_t i = t.size(), j = hits.size(); i > 0; --j)
        if (takes[i * width + j])
            found[--i] = j - 1;
    return found;
}

/// The interval nearest to t.
const HitInterval& nearest(std::span<const HitInterval> hits, double t)
{
    return *std::min_element(hits.begin(), hits.end(),
                             [t](const HitInterval& a, const HitInterval& b) {
                                 return distance(a, t) < distance(b, t);
                             });
}

/// Bounds of each t where there are more t than intervals in `counted`, as a ray that touches a
/// surface hits it twice. A t next to an interval of `hits` outside the range gets empty bounds,
/// unless rounding to single precision may have moved it there.
void bounds_of_more(std::span<const HitInterval> counted, std::span<const HitInterval> hits,
                    const Range& range, std::span<const double> t, std::span<HitBounds> bounds)
{
    for (std::size_t i = 0; i < t.size(); ++i) {
        const HitInterval& hit = nearest(counted, t[i]);
        const bool is_near = distance(hit, t[i]) <= Quad(0x1p-22) * magnitude(t[i]);
        bounds[i] = is_near || may_count(nearest(hits, t[i]), range)
                        ? with_overlapping(hit, counted, range)
                        : HitBounds{};
    }
}

/// Bounds of several hits in the range. `t` holds their rounded values in rising order.
void bounds_of(std::span<const HitInterval> hits, const Range& range, std::span<const double> t,
               std::span<HitBounds> bounds)
{
    std::vector<HitInterval> counted;
    for (HitInterval hit : hits) {
        if (!may_count(hit, range))
            continue;
        // Where a hit may lie outside the range, it may be passed over.
        hit.certain = surely_counts(hit, range);
        counted.insert(counted.end(), static_cast<std::size_t>(hit.hits), hit);
    }
    if (counted.empty()) {
        std::fill(bounds.begin(), bounds.end(), HitBounds{});
        return;
    }
    if (t.size() > counted.size()) {
        bounds_of_more(counted, hits, range, t, bounds);
        return;
    }
    const std::vector<std::size_t> found = in_order(counted, t);
    for (std::size_t i = 0; i < t.size(); ++i)
        bounds[i] = with_overlapping(counted[found[i]], counted, range);
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
    // A ray with a NaN hits nothing; line_hits() could prove nothing about it.
    if (glm::any(glm::isnan(line.org)) || glm::any(glm::isnan(line.dir)))
        return {};
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
