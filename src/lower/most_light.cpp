#include "lower/lowered_scene.hpp"

#include <glm/common.hpp>

#include <cmath>

namespace packtrace {
namespace {

/// Unit roundoff of single precision, the lowest precision of pictures.
constexpr double roundoff = 0x1p-24;

// docs/numerics_derivations.md derives the numbers of roundings.

/// R·V exceeds 1 by at most this many roundoffs.
constexpr double cosine_roundoffs = 32.0;

/// Roundings of one generation's sums, and of each light's part in them.
constexpr double sum_roundoffs = 32.0;
constexpr double light_roundoffs = 8.0;

/// The largest factor of a light's share through glass: each object multiplies the share once, and
/// a surface belongs to one object.
Rgb largest_share(const LoweredScene& lowered)
{
    Rgb share(1.0);
    if (!lowered.transparent_shadows)
        return share;
    for (const abi::MaterialIndex& index : lowered.material_index)
        share *= glm::max(
            Rgb(1.0), glm::abs(lowered.materials[static_cast<std::size_t>(index.first)].transmit));
    return share;
}

/// The sum of the intensities of all lights but the ambient ones.
Rgb all_lights(const LoweredScene& lowered)
{
    Rgb sum(0.0);
    for (const Light& light : lowered.lights)
        sum += glm::abs(light.intensity);
    return sum;
}

/// The largest light of a ray that hits nothing.
Rgb most_outside(const LoweredScene& lowered)
{
    const Rgb background = glm::abs(lowered.background);
    return lowered.visible_lights ? glm::max(background, all_lights(lowered)) : background;
}

/// The largest local light: N·L is 1 for all lights, and R·V is 1 up to rounding.
Rgb most_local(const LoweredMaterial& material, const Rgb& lights)
{
    const Rgb highlight(std::exp(cosine_roundoffs * roundoff * material.shininess));
    return glm::abs(material.ambient) +
           lights * (glm::abs(material.diffuse) + highlight * glm::abs(material.highlight));
}

}  // namespace

std::vector<Rgb> most_light(const LoweredScene& lowered)
{
    const Rgb lights = all_lights(lowered) * largest_share(lowered);
    const double rounded =
        1.0 +
        (sum_roundoffs + light_roundoffs * static_cast<double>(lowered.lights.size())) * roundoff;
    const Rgb outside = most_outside(lowered);
    std::vector<Rgb> most(static_cast<std::size_t>(lowered.max_depth) + 1, outside);
    // From the last generation, whose hits have no children, to the first.
    for (std::size_t left = 0; left < most.size(); ++left) {
        Rgb& here = most[most.size() - 1 - left];
        for (const LoweredMaterial& material : lowered.materials) {
            const Rgb passed_on = glm::abs(material.reflect) + glm::abs(material.transmit);
            const Rgb local = most_local(material, lights);
            const Rgb hit =
                left == 0 ? local + passed_on * glm::abs(lowered.limit_color)
                          : glm::abs(material.local) * local + passed_on * most[most.size() - left];
            here = glm::max(here, rounded * hit);
        }
    }
    return most;
}

}  // namespace packtrace
