#pragma once

#include <packtrace/scene.hpp>

#include "scene/text_writer.hpp"

#include <map>
#include <string>

namespace packtrace::writer {

/// The keys of every named material, as `material_text` gives them.
using MaterialTexts = std::map<std::string, std::string, std::less<>>;

/// The keys of a material, each with a blank before it. Throws std::invalid_argument when it
/// does not belong to the scene's illumination.
[[nodiscard]] std::string material_text(const Material& material, Illumination illumination);

/// Writes what named materials the objects have, each as its first object has it.
[[nodiscard]] MaterialTexts write_materials(TextWriter& out, const Scene& scene);
void write_objects(TextWriter& out, const Scene& scene, const MaterialTexts& materials);
void write_settings(TextWriter& out, const Scene& scene);
void write_lights(TextWriter& out, const Scene& scene);
void write_animation(TextWriter& out, const Animation& animation);

}  // namespace packtrace::writer
