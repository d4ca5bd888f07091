#include <packtrace/write_scene.hpp>

#include "scene/scene_writer.hpp"

namespace packtrace {

std::string scene_text(const Scene& scene)
{
    writer::TextWriter out;
    writer::write_settings(out, scene);
    writer::write_lights(out, scene);
    if (scene.animation)
        writer::write_animation(out, *scene.animation);
    const writer::MaterialTexts materials = writer::write_materials(out, scene);
    writer::write_objects(out, scene, materials);
    return out.take();
}

}  // namespace packtrace
