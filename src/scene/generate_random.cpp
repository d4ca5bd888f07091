#include <packtrace/generate.hpp>

#include "scene/generate_setting.hpp"

namespace packtrace {
namespace {

/// Number `counter` of the sequence of `seed`: the mixer of Steele, Lea, Flood, Fast Splittable
/// Pseudorandom Number Generators, 2014, which needs no state.
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t counter)
{
    std::uint64_t bits = seed + (counter + 1) * 0x9E3779B97F4A7C15u;
    bits = (bits ^ (bits >> 30u)) * 0xBF58476D1CE4E5B9u;
    bits = (bits ^ (bits >> 27u)) * 0x94D049BB133111EBu;
    return bits ^ (bits >> 31u);
}

/// A multiple of 1e-7 in [0, 1).
double coordinate(std::uint64_t bits)
{
    constexpr std::uint64_t steps = 10'000'000;
    return static_cast<double>(bits % steps) / static_cast<double>(steps);
}

}  // namespace

Scene generate_random_spheres(const RandomSpheresOptions& options)
{
    generators::check_option("count", options.count, 1, 10'000'000);
    generators::check_radius(options.radius);
    const Material material = generators::shiny("ball", {0.9, 0.7, 0.4}, options.reflective);
    Scene scene = generators::empty_scene({1.58, 1.31, -0.688}, Vec3(0.5), {0, 1, 0});
    scene.lights = generators::lamp_at({2.5, 2.5, -2});
    const auto count = static_cast<std::uint64_t>(options.count);
    scene.objects.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        Vec3 center;
        for (int axis = 0; axis < 3; ++axis)
            center[axis] =
                coordinate(random_bits(options.seed, 3 * i + static_cast<std::uint64_t>(axis)));
        generators::add_sphere(scene, center, options.radius, material);
    }
    return scene;
}

}  // namespace packtrace
