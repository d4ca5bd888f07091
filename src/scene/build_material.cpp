#include "scene/numbers.hpp"
#include "scene/quote.hpp"
#include "scene/scene_builder.hpp"
#include "scene/values.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <string>

namespace packtrace::reader {
namespace {

double read_reflective(const Field& field)
{
    return read_number_in(field, {0.0, 1.0});
}

/// -1 is note 001's "no highlight".
double read_exponent(const Field& field)
{
    const double exponent = read_number(field);
    if (exponent < 0.0 && exponent != -1.0)
        fail(field.source, field.entry.value[0].at,
             "'specular' is " + to_text(exponent) +
                 "; use an exponent of 0 or more, or -1 for no highlight");
    return exponent;
}

ScratchMaterial build_scratch(const Block& block)
{
    ScratchMaterial material;
    block.set("specular", material.specular, read_exponent);
    block.set("reflective", material.reflective, read_reflective);
    return material;
}

SketchMaterial build_sketch(const Block& block)
{
    SketchMaterial material;
    block.set("ambient", material.ambient, read_factor);
    block.set("diffuse", material.diffuse, read_factor);
    block.set("specular", material.specular, read_factor);
    block.set("refractive", material.refractive, read_factor);
    block.set("shininess", material.shininess, read_not_negative);
    block.set("ior", material.ior, read_positive);
    return material;
}

WhittedMaterial build_whitted(const Block& block)
{
    WhittedMaterial material;
    block.set("ambient", material.ambient, read_factor);
    block.set("diffuse", material.diffuse, read_factor);
    block.set("specular", material.specular, read_factor);
    block.set("transmissive", material.transmissive, read_factor);
    block.set("shininess", material.shininess, read_not_negative);
    block.set("ior", material.ior, read_positive);
    return material;
}

std::array<double, 4> read_reflectance(const Field& field)
{
    std::array<double, 4> reflectance{};
    const std::vector<double> numbers = read_numbers(field, 4, "(0.2, 0.6, 0.2, 16)");
    for (std::size_t i = 0; i < 4; ++i) {
        if (numbers[i] < 0.0)
            fail(field.source, field.entry.value[0].parts[i].at,
                 "'reflectance' has r" + std::to_string(i) + " = " + to_text(numbers[i]) +
                     "; use numbers of 0 or more");
        reflectance[i] = numbers[i];
    }
    return reflectance;
}

ShaderMaterial build_shader(const Block& block)
{
    ShaderMaterial material;
    block.set("reflectance", material.reflectance, read_reflectance);
    return material;
}

GeneralMaterial build_general(const Block& block)
{
    GeneralMaterial material;
    block.set("ambient", material.ambient, read_factor);
    block.set("diffuse", material.diffuse, read_factor);
    block.set("highlight", material.highlight, read_factor);
    block.set("reflect", material.reflect, read_factor);
    block.set("transmit", material.transmit, read_factor);
    block.set("shininess", material.shininess, read_not_negative);
    block.set("ior", material.ior, read_positive);
    return material;
}

}  // namespace

Material build_material(const Block& block, Illumination illumination)
{
    Material material;
    block.set("color", material.color, read_color);
    switch (illumination) {
        case Illumination::scratch:
            material.model = build_scratch(block);
            break;
        case Illumination::sketch:
            material.model = build_sketch(block);
            break;
        case Illumination::whitted:
            material.model = build_whitted(block);
            break;
        case Illumination::shader:
            material.model = build_shader(block);
            break;
        case Illumination::general:
            material.model = build_general(block);
            break;
    }
    return material;
}

NamedMaterials build_named_materials(const Block& file, Illumination illumination)
{
    NamedMaterials materials;
    std::map<std::string_view, std::uint32_t> lines;
    for (const Field& field : file.fields()) {
        if (field.entry.key.text != "material")
            continue;
        refuse_foreign_keys(field, illumination);
        const Block block(field, "material", material_keys(illumination));
        if (!field.entry.name || field.entry.name->text.empty())
            field.fail("the material has no name; write material gold { ... }");
        const Word& name = *field.entry.name;
        const auto [earlier, added] = lines.emplace(name.text, name.at.line);
        if (!added)
            fail(field.source, name.at,
                 "material " + quote(name.text) + " is defined twice, first on line " +
                     std::to_string(earlier->second) + "; give one of them another name");
        Material& material = materials[name.text] = build_material(block, illumination);
        material.name = name.text;
    }
    return materials;
}

}  // namespace packtrace::reader
