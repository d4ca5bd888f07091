#include "scene/scene_builder.hpp"
#include "scene/values.hpp"

namespace packtrace::reader {
namespace {

constexpr std::string_view light_types[] = {"ambient", "point", "directional"};

void refuse(const Block& block, std::string_view key, const std::string& reason)
{
    if (const auto field = block.find(key))
        field->fail(reason);
}

Vec3 read_vector(const Block& block, LightType type)
{
    if (type != LightType::point)
        refuse(block, "position", "only a point light has a position; remove it");
    if (type != LightType::directional)
        refuse(block, "direction", "only a directional light has a direction; remove it");
    if (type == LightType::point)
        return read_point(block.require("position", "(2, 1, 0)"));
    if (type == LightType::directional)
        return read_direction(block.require("direction", "(1, 4, 4)"));
    return Vec3(0.0);
}

}  // namespace

Light build_light(const Field& field)
{
    const Block block(field, "light",
                      {"type", "intensity", "position", "direction", "casts_shadow"});
    Light light;
    light.type = static_cast<LightType>(read_choice(block.require("type", "point"), light_types));
    light.intensity = read_factor(block.require("intensity", "0.6"));
    light.vector = read_vector(block, light.type);
    if (light.type == LightType::ambient)
        refuse(block, "casts_shadow", "an ambient light casts no shadow anyway; remove it");
    block.set("casts_shadow", light.casts_shadow, read_flag);
    return light;
}

}  // namespace packtrace::reader
