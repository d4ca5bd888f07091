#include "scene/scene_writer.hpp"

#include <array>

namespace packtrace::writer {
namespace {

// In the order of their enumerations.
constexpr std::string_view illuminations[] = {"scratch", "sketch", "whitted", "shader", "general"};
constexpr std::string_view shadow_kinds[] = {"none", "opaque", "transparent"};
constexpr std::string_view depth_limits[] = {"background", "local"};
constexpr std::string_view light_types[] = {"ambient", "point", "directional"};

template <std::size_t count, class Choice>
std::string_view word(const std::string_view (&words)[count], Choice choice)
{
    return words[static_cast<std::size_t>(choice)];
}

void write_camera(TextWriter& out, const Camera& camera)
{
    std::array<double, 9> rows{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            rows[static_cast<std::size_t>(3 * row + column)] = camera.rotation[column][row];
    out.put("camera { position = ").put(camera.position);
    out.put(" rotation = ").put(std::span<const double>(rows));
    if (camera.fov)
        out.put(" fov = ").put(*camera.fov);
    out.put(" }\n");
}

}  // namespace

void write_settings(TextWriter& out, const Scene& scene)
{
    const Camera& camera = scene.camera;
    out.put("image_size = ").put(scene.width).put(" x ").put(scene.height).put("\n");
    out.put("background = ").put_color(scene.background).put("\n");
    out.line("illumination", word(illuminations, scene.illumination));
    out.line("max_depth", scene.max_depth);
    if (scene.illumination == Illumination::general)
        out.line("depth_limit", word(depth_limits, scene.depth_limit));
    out.line("shadows", word(shadow_kinds, scene.shadows));
    out.put("viewport_size = ").put(camera.viewport.x).put(" x ").put(camera.viewport.y).put("\n");
    out.line("projection_plane_d", camera.distance);
    out.line("pixel_sample", std::span<const double>(&camera.pixel_sample.x, 2));
    write_camera(out, camera);
}

void write_lights(TextWriter& out, const Scene& scene)
{
    for (const Light& light : scene.lights) {
        out.put("light { type = ").put(word(light_types, light.type));
        out.put(" intensity = ").put(light.intensity);
        if (light.type == LightType::point)
            out.put(" position = ").put(light.vector);
        if (light.type == LightType::directional)
            out.put(" direction = ").put(light.vector);
        if (!light.casts_shadow)
            out.put(" casts_shadow = no");
        out.put(" }\n");
    }
}

void write_animation(TextWriter& out, const Animation& animation)
{
    out.put("animation { frames = ").put(animation.frames).put("\n");
    if (const auto& orbit = animation.orbit)
        out.put("orbit { center = ")
            .put(orbit->center)
            .put(" axis = ")
            .put(orbit->axis)
            .put(" degrees = ")
            .put(orbit->degrees)
            .put(" }\n");
    for (const CameraKey& key : animation.keys) {
        out.put("key { frame = ").put(key.frame).put(" position = ").put(key.position);
        out.put(" look_at = ").put(key.look_at).put(" up = ").put(key.up).put(" }\n");
    }
    out.put("}\n");
}

}  // namespace packtrace::writer
