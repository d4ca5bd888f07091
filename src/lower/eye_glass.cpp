#include "lower/eye_glass.hpp"

#include <algorithm>
#include <utility>

namespace packtrace {
std::vector<std::int32_t> glass_around(const Vec3& eye, const Vec3& forward,
                                       const LoweredScene& lowered)
{
    std::vector<std::pair<double, std::int32_t>> exits;
    for_each_surface(lowered, [&](const auto& surface) {
        const auto& index = lowered.material_index[static_cast<std::size_t>(surface.surface)];
        const auto& material = lowered.materials[static_cast<std::size_t>(index.first)];
        if (material.transmit == Rgb(0.0))
            return;
        if (const Exit exit = exit_of(surface, eye, forward))
            exits.emplace_back(*exit, index.object);
    });
    std::sort(exits.begin(), exits.end());
    // Of too many, the outermost are remembered, as if the ray had entered them one by one.
    const std::size_t depth = abi::glass_depth;
    const std::size_t skip = exits.size() > depth ? exits.size() - depth : 0;
    std::vector<std::int32_t> inside;
    for (std::size_t i = skip; i < exits.size(); ++i)
        inside.push_back(exits[i].second);
    return inside;
}

}  // namespace packtrace
