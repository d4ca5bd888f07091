#include <vector>

#include "lower/lowered_scene.hpp"

namespace packtrace {
namespace {

bool grey(const Rgb& color)
{
    return color.x == color.y && color.y == color.z;
}

void add_features(const LoweredMaterial& material, abi::Features& features)
{
    features.highlights |= material.highlight != Rgb(0.0);
    features.bounces |= material.reflect != Rgb(0.0) || material.transmit != Rgb(0.0);
    features.colored |= !grey(material.reflect) || !grey(material.transmit);
    features.glass |= material.transmit != Rgb(0.0);
}

/// By material: whether a surface has it.
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

}  // namespace

abi::Features features_of(const LoweredScene& lowered)
{
    abi::Features features;
    features.quadrics = !lowered.quadrics.empty() || !lowered.polygons.empty();
    const std::vector<bool> used = used_materials(lowered);
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i])
            add_features(lowered.materials[i], features);
    return features;
}

}  // namespace packtrace
