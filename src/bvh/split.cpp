#include "bvh/split.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>

namespace packtrace {
namespace {

/// Bins on each axis, as many as Wald took (2007).
constexpr int bin_count = 16;

/// Bins are a little wider than a bin_count-th of the range, so that the last centre falls into the
/// last bin however its place is rounded.
constexpr float bin_scale = 0.999f;

/// Larger ranges are read by several threads: enough work for a task to be worth its start.
constexpr std::size_t parallel_items = std::size_t{1} << 15;

/// Which bin on each axis a centre falls into. If the centres are so far apart that their distance
/// overflows, all fall into the first bin; if they are so close that the scale overflows, into the
/// first and the last.
struct Binning {
    Float4 start, scale;

    explicit Binning(const Box4& centroids) : start(centroids.low)
    {
        const Float4 size = centroids.high - centroids.low;
        for (int axis = 0; axis < 4; ++axis)
            scale[axis] = axis < 3 && size[axis] > 0.0f
                              ? static_cast<float>(bin_count) * bin_scale / size[axis]
                              : 0.0f;
    }

    /// By axis; the fourth value has no meaning.
    [[nodiscard]] Int4 operator()(Float4 center) const
    {
        constexpr auto last = static_cast<float>(bin_count - 1);
        const Float4 place = (center - start) * scale;
        // In this order NaN falls into the first bin, because it is not larger than 0.
        const Float4 clamped = smaller(larger(place, Float4{}), Float4{last, last, last, last});
        return __builtin_convertvector(clamped, Int4);
    }
};

struct Bins {
    Box4 box[3][bin_count];
    std::uint32_t count[3][bin_count] = {};

    void include(std::span<const BvhItem> items, const Binning& binning)
    {
        for (const BvhItem& item : items) {
            const Int4 bin = binning(centroid(item));
            for (int axis = 0; axis < 3; ++axis) {
                box[axis][bin[axis]].include(low_of(item), high_of(item));
                ++count[axis][bin[axis]];
            }
        }
    }
    void include(const Bins& other)
    {
        for (int axis = 0; axis < 3; ++axis)
            for (int i = 0; i < bin_count; ++i) {
                box[axis][i].include(other.box[axis][i]);
                count[axis][i] += other.count[axis][i];
            }
    }
};

void fill_bins(std::span<const BvhItem> items, const Binning& binning, Bins& bins)
{
    if (items.size() < parallel_items)
        return bins.include(items, binning);
    bins = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, items.size(), parallel_items), Bins{},
        [&](const tbb::blocked_range<std::size_t>& part, Bins sum) {
            sum.include(items.subspan(part.begin(), part.size()), binning);
            return sum;
        },
        [](Bins a, const Bins& b) {
            a.include(b);
            return a;
        });
}

struct Cut {
    int axis = -1;  ///< -1: none has a finite cost
    int bin = 0;    ///< the first bin of the upper side
    float cost = std::numeric_limits<float>::infinity();
};

/// Compares the boundaries between an axis' bins with the best cut so far. A cut costs area times
/// count, summed over both sides.
void look_for_cut(const Bins& bins, int axis, Cut& best)
{
    float lower_cost[bin_count] = {};
    Box4 lower;
    std::uint32_t below = 0;
    for (int i = 0; i + 1 < bin_count; ++i) {
        lower.include(bins.box[axis][i]);
        below += bins.count[axis][i];
        lower_cost[i + 1] = below == 0 ? std::numeric_limits<float>::infinity()
                                       : half_area(lower) * static_cast<float>(below);
    }
    Box4 upper;
    std::uint32_t above = 0;
    for (int i = bin_count - 1; i > 0; --i) {
        upper.include(bins.box[axis][i]);
        above += bins.count[axis][i];
        const float cost = lower_cost[i] + half_area(upper) * static_cast<float>(above);
        if (above > 0 && cost < best.cost)
            best = {axis, i, cost};
    }
}

/// Sorts the items to the two sides of a cut and finds the boxes of their centres; returns how many
/// are below. Every item is swapped, which costs less than a mispredicted branch.
std::size_t sort_sides(std::span<BvhItem> items, const Binning& binning, const Cut& cut,
                       Box4 (&centroids)[2])
{
    std::size_t below = 0;
    for (BvhItem& item : items) {
        const BvhItem here = item;
        const Float4 center = centroid(here);
        const bool is_below = binning(center)[cut.axis] < cut.bin;
        centroids[is_below ? 0 : 1].include(center, center);
        item = items[below];
        items[below] = here;
        below += is_below ? 1 : 0;
    }
    return below;
}

/// Both halves with their boxes, which are computed from their items.
std::pair<BvhRange, BvhRange> halves(std::span<const BvhItem> items, const BvhRange& range,
                                     std::size_t middle)
{
    return {range_of(items, range.begin, middle), range_of(items, middle, range.end)};
}

}  // namespace

BvhRange range_of(std::span<const BvhItem> items, std::size_t begin, std::size_t end)
{
    BvhRange empty;
    const auto include = [&](std::size_t first, std::size_t last, BvhRange range) {
        for (std::size_t i = first; i < last; ++i) {
            range.box.include(low_of(items[i]), high_of(items[i]));
            range.centroids.include(centroid(items[i]), centroid(items[i]));
        }
        return range;
    };
    BvhRange range;
    if (end - begin < parallel_items)
        range = include(begin, end, empty);
    else
        range = tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(begin, end, parallel_items), empty,
            [&](const tbb::blocked_range<std::size_t>& part, const BvhRange& sum) {
                return include(part.begin(), part.end(), sum);
            },
            [](BvhRange a, const BvhRange& b) {
                a.box.include(b.box);
                a.centroids.include(b.centroids);
                return a;
            });
    range.begin = begin;
    range.end = end;
    return range;
}

std::pair<BvhRange, BvhRange> split(std::span<BvhItem> items, const BvhRange& range)
{
    const Binning binning(range.centroids);
    const auto members = items.subspan(range.begin, range.count());
    Bins bins;
    fill_bins(members, binning, bins);
    Cut cut;
    for (int axis = 0; axis < 3; ++axis)
        look_for_cut(bins, axis, cut);
    if (cut.axis < 0)
        return split_number(items, range);
    Box4 centroids[2];
    const std::size_t middle = range.begin + sort_sides(members, binning, cut, centroids);
    BvhRange below{range.begin, middle, {}, centroids[0]};
    BvhRange above{middle, range.end, {}, centroids[1]};
    for (int i = 0; i < bin_count; ++i)
        (i < cut.bin ? below : above).box.include(bins.box[cut.axis][i]);
    return {below, above};
}

std::pair<BvhRange, BvhRange> split_number(std::span<BvhItem> items, const BvhRange& range)
{
    const auto members = items.subspan(range.begin, range.count());
    const Float4 size = range.centroids.high - range.centroids.low;
    const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    const auto middle = members.begin() + static_cast<std::ptrdiff_t>(range.count() / 2);
    // Numbers break ties, so that the outcome does not depend on the order found.
    std::nth_element(members.begin(), middle, members.end(),
                     [axis](const BvhItem& a, const BvhItem& b) {
                         const float left = centroid(a)[axis];
                         const float right = centroid(b)[axis];
                         return left < right || (left == right && a.number < b.number);
                     });
    return halves(items, range, range.begin + range.count() / 2);
}

std::pair<BvhRange, BvhRange> split_kinds(std::span<BvhItem> items, const BvhRange& range)
{
    const auto members = items.subspan(range.begin, range.count());
    const std::uint32_t kind = members.front().kind;
    const auto middle = std::partition(members.begin(), members.end(),
                                       [&](const BvhItem& item) { return item.kind == kind; });
    return halves(items, range, range.begin + static_cast<std::size_t>(middle - members.begin()));
}

}  // namespace packtrace
