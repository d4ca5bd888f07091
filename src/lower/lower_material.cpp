#include "lower/lower_material.hpp"

#include <variant>

#include <packtrace/read_scene.hpp>

namespace packtrace {
namespace {

/// Note 001: the colour tints all of the local light, the highlight too; the mirror is white
/// and takes its share from the local light.
LoweredMaterial lower_model(const ScratchMaterial& material, const Rgb& color, const Rgb& ambient)
{
    LoweredMaterial lowered;
    lowered.ambient = color * ambient;
    lowered.diffuse = color;
    if (material.specular != -1.0) {
        lowered.highlight = color;
        lowered.shininess = material.specular;
    }
    if (material.reflective > 0.0) {
        lowered.reflect = Rgb(material.reflective);
        lowered.local = Rgb(1.0 - material.reflective);
    }
    return lowered;
}

LoweredMaterial lower_color(const Object& object, const Rgb& color, const Rgb& ambient)
{
    if (const auto* scratch = std::get_if<ScratchMaterial>(&object.material.model))
        return lower_model(*scratch, color, ambient);
    throw SceneError("object '" + object.name +
                     "': the packet kernels know the illumination 'scratch' only; "
                     "use illumination = scratch");
}

}  // namespace

void lower_material(const Object& object, const Rgb& ambient, LoweredScene& lowered)
{
    const Material& material = object.material;
    abi::MaterialIndex index{static_cast<std::int32_t>(lowered.materials.size()), -1};
    lowered.materials.push_back(lower_color(object, material.color, ambient));

    const auto* plane = std::get_if<Plane>(&object.surface);
    if (material.checker && plane != nullptr) {
        index.checker = static_cast<std::int32_t>(lowered.checkers.size());
        const double size = material.checker->size;
        lowered.checkers.push_back({plane->point, plane->u / size, plane->v / size});
        lowered.materials.push_back(lower_color(object, material.checker->other, ambient));
    }
    lowered.material_index.push_back(index);
}

}  // namespace packtrace
