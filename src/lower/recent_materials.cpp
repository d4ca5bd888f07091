#include "lower/recent_materials.hpp"

#include <cstring>

namespace packtrace {
namespace {

constexpr std::size_t words = sizeof(LoweredMaterial) / sizeof(std::uint64_t);
static_assert(sizeof(LoweredMaterial) == 20 * sizeof(double), "no byte between the values");

std::uint64_t hash_of(const LoweredMaterial& material)
{
    std::uint64_t word[words];
    std::memcpy(word, &material, sizeof material);
    std::uint64_t hash = 0;
    for (const std::uint64_t value : word)
        hash = (hash ^ value) * 0x9E3779B97F4A7C15u + (hash >> 32u);
    return hash >> 32u;
}

/// Bit for bit: -0 and 0 shade alike, but are two materials.
bool same(const LoweredMaterial& a, const LoweredMaterial& b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

std::int32_t RecentMaterials::place_of(const LoweredMaterial& material,
                                       std::vector<LoweredMaterial>& materials)
{
    const auto is_at = [&](std::int32_t place) {
        return place >= 0 && same(materials[static_cast<std::size_t>(place)], material);
    };
    // Neighbours are often alike, and comparing costs less than a hash.
    if (is_at(latest_))
        return latest_;
    std::int32_t& place = places_[hash_of(material) % places_.size()];
    if (!is_at(place)) {
        place = static_cast<std::int32_t>(materials.size());
        materials.push_back(material);
    }
    latest_ = place;
    return place;
}

}  // namespace packtrace
