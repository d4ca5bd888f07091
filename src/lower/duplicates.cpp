#include "lower/duplicates.hpp"

#include <cstdint>
#include <functional>
#include <tuple>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace packtrace {
namespace {

template <class... Part>
std::uint64_t hash_of(const std::tuple<Part...>& key)
{
    std::uint64_t hash = 0;
    const auto mix = [&](std::uint64_t part) {
        hash = (hash ^ part) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    };
    std::apply([&](const auto&... part) { (mix(std::hash<double>()(double(part))), ...); }, key);
    return hash;
}

std::uint64_t hash_of(const std::vector<double>& key)
{
    std::uint64_t hash = 0;
    for (const double part : key)
        hash = hash_of(std::tuple(double(hash >> 12), part));
    return hash;
}

struct HashedSurface {
    std::uint64_t hash;
    std::uint32_t number;  ///< in the list

    bool operator<(const HashedSurface& other) const
    {
        return hash < other.hash || (hash == other.hash && number < other.number);
    }
};

template <class Surface>
std::vector<HashedSurface> sorted_by_hash(const std::vector<Surface>& surfaces)
{
    std::vector<HashedSurface> sorted(surfaces.size());
    tbb::parallel_for(std::size_t{0}, sorted.size(), [&](std::size_t i) {
        sorted[i] = {hash_of(key_of(surfaces[i])), static_cast<std::uint32_t>(i)};
    });
    tbb::parallel_sort(sorted.begin(), sorted.end());
    return sorted;
}

/// Of equal surfaces all but the first. What differs in its shadow stays.
template <class Surface>
std::size_t remove_duplicates_of(std::vector<Surface>& surfaces, const std::vector<bool>& casts)
{
    const std::vector<HashedSurface> sorted = sorted_by_hash(surfaces);
    const auto casts_shadow = [&](const Surface& surface) {
        return casts.empty() || casts[static_cast<std::size_t>(surface.surface)];
    };
    std::vector<bool> gone(surfaces.size(), false);
    std::size_t count = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        const Surface& earlier = surfaces[sorted[i - 1].number];
        const Surface& later = surfaces[sorted[i].number];
        if (sorted[i - 1].hash == sorted[i].hash && key_of(earlier) == key_of(later) &&
            casts_shadow(earlier) == casts_shadow(later)) {
            gone[sorted[i].number] = true;
            ++count;
        }
    }
    std::size_t number = 0;
    std::erase_if(surfaces, [&](const Surface&) { return gone[number++]; });
    return count;
}

}  // namespace

std::size_t remove_duplicates(LoweredScene& lowered)
{
    if (lowered.features.glass)
        return 0;
    std::size_t count = 0;
    for_each_list(lowered,
                  [&](auto& list) { count += remove_duplicates_of(list, lowered.casts_shadow); });
    return count;
}

}  // namespace packtrace
