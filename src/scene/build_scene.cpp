#include "scene/scene_builder.hpp"

namespace packtrace::reader {
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

}  // namespace

Scene build_scene(const Source& source, const Entry& tree)
{
    const Block file({source, tree}, "the scene", scene_keys(), repeatable_keys());
    Scene scene;
    scene.illumination = read_illumination(file);
    build_settings(file, scene);
    if (const auto camera = file.find("camera"))
        build_camera(*camera, scene.camera);
    const NamedMaterials materials = build_named_materials(file, scene.illumination);
    build_objects(file, materials, scene);
    for (const Field& field : file.fields())
        if (field.entry.key.text == "light")
            scene.lights.push_back(build_light(field));
    if (const auto animation = file.find("animation"))
        scene.animation = build_animation(*animation, scene.camera);
    return scene;
}

}  // namespace packtrace::reader
