#include "cli/scene_summary.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <variant>

namespace packtrace::cli {
namespace {

constexpr std::array illuminations{"scratch", "sketch", "whitted", "shader", "general"};
constexpr std::array shadow_kinds{"none", "opaque", "transparent"};
constexpr std::array light_types{"ambient", "point", "directional"};
// The quadrics follow in the order of QuadricKind.
constexpr std::array surface_kinds{"sphere", "plane",      "ellipsoid",   "cylinder",
                                   "cone",   "paraboloid", "hyperboloid", "hyperboloid2",
                                   "saddle", "quadric"};

std::size_t kind_of(const Surface& surface)
{
    if (std::holds_alternative<Sphere>(surface))
        return 0;
    if (std::holds_alternative<Plane>(surface))
        return 1;
    return 2 + static_cast<std::size_t>(std::get<Quadric>(surface).kind);
}

Census named(std::span<const int> counts, std::span<const char* const> names)
{
    Census census;
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] > 0)
            census.emplace_back(names[i], counts[i]);
    return census;
}

}  // namespace

Census count_objects(const Scene& scene)
{
    std::array<int, surface_kinds.size()> counts{};
    for (const Object& object : scene.objects)
        ++counts[kind_of(object.surface)];
    return named(counts, surface_kinds);
}

Census count_lights(const Scene& scene)
{
    std::array<int, light_types.size()> counts{};
    for (const Light& light : scene.lights)
        ++counts[static_cast<std::size_t>(light.type)];
    return named(counts, light_types);
}

std::string name_of(Illumination illumination)
{
    return illuminations[static_cast<std::size_t>(illumination)];
}

std::string name_of(ShadowKind shadows)
{
    return shadow_kinds[static_cast<std::size_t>(shadows)];
}

}  // namespace packtrace::cli
