#include "scene/scene_writer.hpp"

#include <stdexcept>
#include <variant>

namespace packtrace::writer {
namespace {

void check_color(const Rgb& color)
{
    for (int channel = 0; channel < 3; ++channel)
        if (!(color[channel] >= 0.0 && color[channel] <= 1.0))
            throw std::invalid_argument("a colour outside 0 to 1 can't be written as a scene");
}

/// Writes a model's own keys.
struct Keys {
    TextWriter& out;

    void operator()(const ScratchMaterial& material) const
    {
        out.put(" specular=").put(material.specular);
        out.put(" reflective=").put(material.reflective);
    }
    void operator()(const SketchMaterial& material) const
    {
        out.put(" ambient=").put(material.ambient).put(" diffuse=").put(material.diffuse);
        out.put(" specular=").put(material.specular);
        out.put(" refractive=").put(material.refractive);
        out.put(" shininess=").put(material.shininess).put(" ior=").put(material.ior);
    }
    void operator()(const WhittedMaterial& material) const
    {
        out.put(" ambient=").put(material.ambient).put(" diffuse=").put(material.diffuse);
        out.put(" specular=").put(material.specular);
        out.put(" transmissive=").put(material.transmissive);
        out.put(" shininess=").put(material.shininess).put(" ior=").put(material.ior);
    }
    void operator()(const ShaderMaterial& material) const
    {
        out.put(" reflectance=").put(std::span<const double>(material.reflectance));
    }
    void operator()(const GeneralMaterial& material) const
    {
        out.put(" ambient=").put(material.ambient).put(" diffuse=").put(material.diffuse);
        out.put(" highlight=").put(material.highlight).put(" reflect=").put(material.reflect);
        out.put(" transmit=").put(material.transmit);
        out.put(" shininess=").put(material.shininess).put(" ior=").put(material.ior);
    }
};

void put_checker(TextWriter& out, const Rgb& color, const Checker& checker)
{
    check_color(checker.other);
    out.put(" checker=").put_color(color).put(",").put_color(checker.other);
    out.put(",").put(checker.size);
}

}  // namespace

std::string material_text(const Material& material, Illumination illumination)
{
    if (material.model.index() != static_cast<std::size_t>(illumination))
        throw std::invalid_argument(
            "a material of another illumination than its scene's can't be written");
    TextWriter out;
    check_color(material.color);
    if (material.checker)
        put_checker(out, material.color, *material.checker);
    // The general model knows no colour.
    else if (illumination != Illumination::general)
        out.put(" color=").put_color(material.color);
    std::visit(Keys{out}, material.model);
    return out.take();
}

MaterialTexts write_materials(TextWriter& out, const Scene& scene)
{
    MaterialTexts texts;
    for (const Object& object : scene.objects) {
        const Material& material = object.material;
        if (material.name.empty() || material.checker || texts.contains(material.name))
            continue;
        const std::string text = material_text(material, scene.illumination);
        out.put("material ").put_name(material.name).put(" {").put(text).put(" }\n");
        texts.emplace(material.name, text);
    }
    return texts;
}

}  // namespace packtrace::writer
