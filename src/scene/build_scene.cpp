#include <packtrace/read_scene.hpp>

#include "scene/check_text.hpp"
#include "scene/load_text.hpp"
#include "scene/scene_builder.hpp"
#include "scene/syntax_tree.hpp"

namespace packtrace {
namespace {

const Keys& scene_keys()
{
    static const Keys keys{
        "viewport_size", "projection_plane_d", "image_size", "background",   "illumination",
        "max_depth",     "depth_limit",        "shadows",    "pixel_sample", "camera",
        "animation"};
    return keys;
}

Keys repeatable_keys()
{
    Keys keys = surface_keywords();
    keys.insert(keys.end(), {"light", "material"});
    return keys;
}

/// Only a material takes a name before its brace.
void refuse_block_names(const Block& file)
{
    for (const Field& field : file.fields())
        if (field.entry.name.text.data() != nullptr && field.entry.key.text != "material")
            fail(field.source, field.entry.name.at,
                 "only a material is named before its brace; write name = \"...\" between "
                 "the braces");
}

Scene build_scene(const Block& file)
{
    Scene scene;
    refuse_block_names(file);
    scene.illumination = read_illumination(file);
    build_settings(file, scene);
    if (const auto camera = file.find("camera"))
        build_camera(*camera, scene.camera);
    const NamedMaterials materials = build_named_materials(file, scene.illumination);
    build_objects(file, materials, scene);
    for (const Field& field : file.fields())
        if (field.entry.key.text == "light")
            scene.lights.push_back(build_light(field));
    return scene;
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name)
{
    const Source source{name, text};
    check_text(source);
    const Entry tree = parse_tree(source);
    return build_scene(Block({source, tree}, "the scene", scene_keys(), repeatable_keys()));
}

Scene read_scene(const std::filesystem::path& file)
{
    return parse_scene(load_text(file), file.string());
}

}  // namespace packtrace
