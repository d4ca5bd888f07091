#include "scene/nearest_word.hpp"
#include "scene/quote.hpp"
#include "scene/scene_builder.hpp"
#include "scene/values.hpp"

#include <string>
#include <variant>

namespace packtrace::reader {
namespace {

Keys object_keys(std::string_view keyword, Illumination illumination)
{
    Keys keys = surface_keys(keyword);
    for (const std::string_view key : material_keys(illumination))
        keys.push_back(key);
    keys.insert(keys.end(), {"name", "material", "checker", "casts_shadow"});
    return keys;
}

const Material& find_material(const Field& field, const NamedMaterials& materials)
{
    const std::string_view name = read_name(field);
    if (const auto found = materials.find(name); found != materials.end())
        return found->second;
    Keys names;
    for (const auto& [known, material] : materials)
        names.push_back(known);
    const std::string_view nearest = nearest_word(name, names);
    fail(field.source, field.entry.value[0].at,
         "unknown material " + quote(name) +
             (nearest.empty()
                  ? "; define it with: material " + escape(name.substr(0, 40)) + " { ... }"
                  : "; did you mean " + quote(nearest) + "?"));
}

Material object_material(const Block& block, Illumination illumination,
                         const NamedMaterials& materials)
{
    const auto named = block.find("material");
    if (!named)
        return build_material(block, illumination);
    for (const std::string_view key : material_keys(illumination))
        if (const auto field = block.find(key))
            field->fail(quote(key) +
                        " stands beside a named material; move it into the material "
                        "or remove 'material'");
    return find_material(*named, materials);
}

Checker read_checker(const Field& field, Material& material)
{
    const std::string form = "(255, 255, 255), (0, 0, 0), 1";
    const std::vector<Item>& items = field.entry.value;
    if (items.size() != 3)
        field.fail("'checker' wants two colours and a size; write checker = " + form);
    Checker checker;
    material.color = item_color(field, items[0], form);
    checker.other = item_color(field, items[1], form);
    checker.size = item_number(field, items[2], form);
    if (!(checker.size > 0.0))
        fail(field.source, items[2].at, "the checker's size is not above 0; use a longer edge");
    return checker;
}

void build_checker(const Block& block, Illumination illumination, Object& object)
{
    const auto field = block.find("checker");
    if (!field)
        return;
    if (!std::holds_alternative<Plane>(object.surface))
        field->fail("only a plane can have a checker; remove it and use color");
    if (illumination == Illumination::general)
        field->fail(
            "'checker' has no effect under illumination = general, whose coefficients "
            "know no colour; remove it");
    if (block.find("color"))
        field->fail("'checker' gives both colours; remove 'color'");
    object.material.checker = read_checker(*field, object.material);
}

}  // namespace

Object build_object(const Field& field, Illumination illumination, const NamedMaterials& materials)
{
    const std::string_view keyword = field.entry.key.text;
    refuse_foreign_keys(field, illumination);
    const Block block(field, keyword, object_keys(keyword, illumination), transform_keys());
    Object object;
    object.surface = build_surface(block, keyword);
    object.transform = build_transform(block);
    object.material = object_material(block, illumination, materials);
    build_checker(block, illumination, object);
    block.set("casts_shadow", object.casts_shadow, read_flag);
    return object;
}

}  // namespace packtrace::reader
