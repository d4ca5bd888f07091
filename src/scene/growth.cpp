#include "scene/object_names.hpp"
#include "scene/scene_faults.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

// Finds scenes whose colours may grow beyond single precision, because factors are above 1. Each
// reflection and refraction multiplies by a factor, and so does each object that transmits light in
// a transparent shadow.
namespace packtrace::language {
namespace {

/// The largest colour, as a power of ten. It is well within single precision.
constexpr double most_decades = 36.0;

double largest(const Rgb& color)
{
    return std::max({color.r, color.g, color.b});
}

/// The factors by which a material multiplies light.
struct Factors {
    double bounced = 0.0;  ///< of mirrored and refracted light together
    double shadow = 0.0;   ///< of light that it transmits to other objects
    double local = 0.0;    ///< of local light
};

Factors factors_of(const ScratchMaterial&)
{
    return {1.0, 0.0, 2.0};
}

Factors factors_of(const SketchMaterial& material)
{
    return {largest(material.specular + material.refractive), largest(material.refractive),
            largest(material.ambient + material.diffuse + material.specular)};
}

Factors factors_of(const WhittedMaterial& material)
{
    return {largest(material.specular + material.transmissive), largest(material.transmissive),
            largest(material.ambient + material.diffuse + material.specular)};
}

Factors factors_of(const ShaderMaterial& material)
{
    const auto& r = material.reflectance;
    return {0.0, 0.0, r[0] + r[1] + r[2]};
}

Factors factors_of(const GeneralMaterial& material)
{
    return {largest(material.reflect + material.transmit), largest(material.transmit),
            largest(material.ambient + material.diffuse + material.highlight)};
}

double decades(double factor)
{
    return factor > 1.0 ? std::log10(factor) : 0.0;
}

}  // namespace

std::optional<SceneFault> fault_of_growth(const Scene& scene)
{
    double light = 0.0;
    for (const Light& each : scene.lights)
        light += largest(each.intensity);

    Factors most;
    std::size_t object = 0;
    double in_shadow = 0.0;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Factors factors = std::visit([](const auto& model) { return factors_of(model); },
                                           scene.objects[i].material.model);
        if (factors.bounced > most.bounced) {
            most.bounced = factors.bounced;
            object = i;
        }
        most.local = std::max(most.local, factors.local);
        if (scene.shadows == ShadowKind::transparent)
            in_shadow += decades(factors.shadow);
    }
    const double of_local = decades(light * most.local + 1.0);
    const double of_depth =
        scene.max_depth * decades(most.bounced) + decades(scene.max_depth + 1.0);
    const double all = of_local + of_depth + in_shadow;
    if (all <= most_decades)
        return std::nullopt;
    const std::string message =
        "factors above 1 let colours grow to 1e" + to_text(std::ceil(all)) +
        ", beyond single precision: it mirrors and lets through " + to_text(most.bounced) +
        " times the light, at max_depth = " + std::to_string(scene.max_depth) +
        "; use smaller factors or a lower max_depth";
    return SceneFault{label_of(scene, object), message, "objects", object};
}

}  // namespace packtrace::language
