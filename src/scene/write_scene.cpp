#include <packtrace/write_scene.hpp>

#include <map>
#include <stdexcept>
#include <string>

#include "scene/keys.hpp"

namespace packtrace {
namespace {

using language::ObjectKeys;
using language::write_rows;

/// The keys of every named material, as `material_text` gives them.
using MaterialTexts = std::map<std::string, std::string, std::less<>>;

template <class Owner>
void write_block(std::string& out, std::string_view key, const Owner& owner)
{
    out.append(key).append(" {");
    write_rows(out, owner);
    out += " }\n";
}

void write_animation(std::string& out, const Animation& animation)
{
    out += "animation {";
    write_rows(out, animation);
    out += '\n';
    if (animation.orbit)
        write_block(out, "orbit", *animation.orbit);
    for (const CameraKey& key : animation.keys)
        write_block(out, "key", key);
    out += "}\n";
}

/// The keys of a material, each with a blank before it.
std::string material_text(const Material& material, Illumination illumination)
{
    if (material.model.index() != language::default_material(illumination).model.index())
        throw std::invalid_argument(
            "a material of another illumination than its scene's can't be written");
    std::string out;
    language::visit_parts(material, [&](const auto& part) { write_rows(out, part); });
    return out;
}

/// Writes what named materials the objects have, each as its first object has it.
MaterialTexts write_materials(std::string& out, const Scene& scene)
{
    MaterialTexts texts;
    for (const Object& object : scene.objects) {
        const Material& material = object.material;
        if (material.name.empty() || material.checker || texts.contains(material.name))
            continue;
        const std::string text = material_text(material, scene.illumination);
        out += "material ";
        language::name().write(out, material.name);
        out.append(" {").append(text).append(" }\n");
        texts.emplace(material.name, text);
    }
    return texts;
}

void write_objects(std::string& out, const Scene& scene, const MaterialTexts& materials)
{
    std::map<std::string_view, int> unnamed;
    for (const Object& object : scene.objects) {
        const std::string_view kind = language::word_of(object.surface).word;
        const Material& material = object.material;
        ObjectKeys own;
        own.casts_shadow = object.casts_shadow;
        // Names that the reader gives on its own are not written.
        int& number = unnamed[kind];
        if (object.name.empty() ||
            object.name == std::string(kind) + ' ' + std::to_string(number + 1))
            ++number;
        else
            own.name = object.name;
        if (material.checker)
            own.checker = {material.color, *material.checker};
        const std::string text = material_text(material, scene.illumination);
        const auto named = materials.find(material.name);
        if (named != materials.end() && named->second == text && !material.checker)
            own.material = material.name;

        out.append(kind).append(" {");
        std::visit([&](const auto& surface) { write_rows(out, surface); }, object.surface);
        write_rows(out, object.transform);
        if (!own.material)
            out += text;
        write_rows(out, own);
        out += " }\n";
    }
}

}  // namespace

std::string scene_text(const Scene& scene)
{
    std::string out;
    write_rows(out, scene, "", " = ", "\n");
    language::CameraKeys camera;
    camera.position = scene.camera.position;
    camera.rotation = scene.camera.rotation;
    camera.fov = scene.camera.fov;
    write_block(out, "camera", camera);
    for (const Light& light : scene.lights)
        write_block(out, "light", light);
    if (scene.animation)
        write_animation(out, *scene.animation);
    const MaterialTexts materials = write_materials(out, scene);
    write_objects(out, scene, materials);
    return out;
}

}  // namespace packtrace
