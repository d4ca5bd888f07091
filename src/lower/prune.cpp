#include "lower/prune.hpp"

#include "core/text.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <tuple>

namespace packtrace {
namespace {

bool grey(const Rgb& color)
{
    return color.x == color.y && color.y == color.z;
}

void add_features(const LoweredMaterial& material, LoweredScene& lowered)
{
    lowered.highlights |= material.highlight != Rgb(0.0);
    lowered.bounces |= material.reflect != Rgb(0.0) || material.transmit != Rgb(0.0);
    lowered.features.colored |= !grey(material.reflect) || !grey(material.transmit);
    lowered.features.glass |= material.transmit != Rgb(0.0);
}

/// By material, whether a surface has it.
std::vector<bool> used_materials(const LoweredScene& lowered)
{
    std::vector<bool> used(lowered.materials.size(), false);
    for_each_surface(lowered, [&](const auto& surface) {
        const auto& index = lowered.material_index[static_cast<std::size_t>(surface.surface)];
        const auto first = static_cast<std::size_t>(index.first);
        used[first] = true;
        if (index.checker >= 0)
            used[first + 1] = true;
    });
    return used;
}

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
    std::uint32_t number;  ///< index in the list

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

/// Removes all but the first of equal surfaces; returns how many. Surfaces are not equal where only
/// one casts a shadow.
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

void add(std::vector<LeftOut>& left_out, std::size_t count, const std::string& noun,
         const std::string& why)
{
    if (count > 0)
        left_out.push_back({counted(static_cast<std::int64_t>(count), noun), why});
}

/// Where lights are visible, a dark light hides the background and stays.
std::size_t remove_dark_lights(LoweredScene& lowered)
{
    if (lowered.visible_lights)
        return 0;
    return std::erase_if(lowered.lights,
                         [](const Light& light) { return light.intensity == Rgb(0.0); });
}

/// Mirrors and glass count only where a secondary ray may leave them, or where the depth limit has
/// a colour.
void narrow_bounces(LoweredScene& lowered)
{
    if (lowered.max_depth == 0 && lowered.limit_color == Rgb(0.0))
        lowered.bounces = false;
    if (!lowered.bounces)
        lowered.max_depth = 0;
    lowered.features.glass &= lowered.max_depth > 0 || lowered.transparent_shadows;
    lowered.features.colored &= lowered.bounces;
}

void narrow_shadows(LoweredScene& lowered)
{
    const auto& casts = lowered.casts_shadow;
    const bool nothing_casts =
        !casts.empty() && std::find(casts.begin(), casts.end(), true) == casts.end();
    const bool no_light = std::none_of(lowered.lights.begin(), lowered.lights.end(),
                                       [](const Light& light) { return light.casts_shadow; });
    lowered.shadows &= !nothing_casts && !no_light;
    lowered.transparent_shadows &= lowered.shadows;
    if (!lowered.shadows)
        lowered.casts_shadow.clear();
}

/// Hits of a flat scene show their ambient light only.
void narrow_hits(LoweredScene& lowered)
{
    lowered.flat = lowered.lights.empty() && !lowered.bounces;
}

}  // namespace

void find_features(LoweredScene& lowered)
{
    lowered.features = {.quadrics = !lowered.quadrics.empty() || !lowered.polygons.empty(),
                        .probe = lowered.features.probe,
                        .exact = lowered.features.exact};
    lowered.highlights = lowered.bounces = false;
    const std::vector<bool> used = used_materials(lowered);
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i])
            add_features(lowered.materials[i], lowered);
}

std::size_t remove_duplicates(LoweredScene& lowered)
{
    if (lowered.features.glass)
        return 0;
    std::size_t count = 0;
    for_each_list(lowered,
                  [&](auto& list) { count += remove_duplicates_of(list, lowered.casts_shadow); });
    return count;
}

std::vector<LeftOut> prune(LoweredScene& lowered)
{
    std::vector<LeftOut> left_out;
    add(left_out, remove_dark_lights(lowered), "light", "of no intensity");
    add(left_out, remove_duplicates(lowered), "surface", "in the very place of an earlier one");
    find_features(lowered);
    lowered.highlights &= !lowered.lights.empty();
    narrow_shadows(lowered);
    narrow_bounces(lowered);
    narrow_hits(lowered);
    return left_out;
}

std::vector<LeftOut> unused_features(const LoweredScene& lowered, Traversal traversal)
{
    const abi::Features& uses = lowered.features;
    std::vector<LeftOut> unused;
    const auto unless = [&](bool used, const char* what, const char* why) {
        if (!used)
            unused.push_back({what, why});
    };
    unless(traversal == Traversal::tree, "hierarchy", "lists are quicker for so few");
    unless(uses.quadrics, "quadrics", "no surface is one");
    unless(uses.exact, "certain tests and refinement", "--accuracy fast does without");
    unless(!lowered.checkers.empty(), "checkers", "no plane has one");
    unless(!lowered.lights.empty(), "lights", "none shines from a place or a direction");
    unless(!lowered.flat, "normals", "no light and no mirror asks for them");
    unless(lowered.highlights || lowered.lights.empty(), "highlights", "no material has one");
    unless(lowered.shadows || lowered.lights.empty(), "shadow rays",
           "nothing casts a shadow, or no light has any");
    unless(lowered.bounces, "mirrored rays", "nothing mirrors, or the depth is 0");
    unless(uses.glass, "refracted rays", "nothing lets light through");
    unless(uses.colored || !lowered.bounces, "weights by channel", "mirrors and glass are grey");
    return unused;
}

}  // namespace packtrace
