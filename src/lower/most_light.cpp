#include "lower/lowered_scene.hpp"

#include <glm/common.hpp>

#include <cmath>

namespace packtrace {
namespace {

/// Roundoff of single precision, the coarsest that pictures are rendered in.
constexpr double roundoff = 0x1p-24;

/// What a light's share can grow to on its way through glass: each object multiplies it once, and
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

/// The intensities of all lights that shine from a place or a direction.
Rgb all_lights(const LoweredScene& lowered)
{
    Rgb sum(0.0);
    for (const Light& light : lowered.lights)
        sum += glm::abs(light.intensity);
    return sum;
}

/// What a ray brings that hits nothing.
Rgb most_outside(const LoweredScene& lowered)
{
    const Rgb background = glm::abs(lowered.background);
    return lowered.visible_lights ? glm::max(background, all_lights(lowered)) : background;
}

/// All lights at their best place: N·L is 1, and so is R·V but for its rounding.
Rgb most_local(const LoweredMaterial& material, const Rgb& lights)
{
    const Rgb highlight(std::exp(32.0 * roundoff * material.shininess));
    return glm::abs(material.ambient) +
           lights * (glm::abs(material.diffuse) + highlight * glm::abs(material.highlight));
}

}  // namespace

std::vector<Rgb> most_light(const LoweredScene& lowered)
{
    const Rgb lights = all_lights(lowered) * largest_share(lowered);
    const double rounded =
        1.0 + (32.0 + 8.0 * static_cast<double>(lowered.lights.size())) * roundoff;
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
