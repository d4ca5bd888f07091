#include "scene/numbers.hpp"
#include "scene/quote.hpp"
#include "scene/scene_builder.hpp"
#include "scene/values.hpp"

#include <cmath>

namespace packtrace::reader {
namespace {

constexpr double largest_side = 65536.0;
constexpr int deepest = 64;

constexpr std::string_view illuminations[] = {"scratch", "sketch", "whitted", "shader", "general"};
constexpr std::string_view shadow_kinds[] = {"none", "opaque", "transparent"};
constexpr std::string_view depth_limits[] = {"background", "local"};

void read_image_size(const Field& field, Scene& scene)
{
    const Vec2 size = read_size(field);
    for (int i = 0; i < 2; ++i)
        if (size[i] != std::floor(size[i]) || size[i] > largest_side)
            fail(field.source, field.entry.value[0].parts[static_cast<std::size_t>(i)].at,
                 "'image_size' has a side of " + to_text(size[i]) +
                     " pixels; use whole numbers from 1 to " + to_text(largest_side));
    scene.width = static_cast<int>(size.x);
    scene.height = static_cast<int>(size.y);
}

Vec2 read_pixel_sample(const Field& field)
{
    const Vec2 sample = read_pair(field);
    for (int i = 0; i < 2; ++i)
        if (!(sample[i] >= 0.0 && sample[i] <= 1.0))
            fail(field.source, field.entry.value[0].parts[static_cast<std::size_t>(i)].at,
                 "'pixel_sample' lies outside its pixel at " + to_text(sample[i]) +
                     "; use numbers from 0 to 1");
    return sample;
}

ShadowKind read_shadows(const Field& field)
{
    return static_cast<ShadowKind>(read_choice(field, shadow_kinds));
}

void read_depth_limit(const Field& field, Scene& scene)
{
    if (scene.illumination != Illumination::general)
        field.fail(
            "'depth_limit' belongs to illumination = general, the other models have a rule of "
            "their own; remove it");
    scene.depth_limit = static_cast<DepthLimit>(read_choice(field, depth_limits));
}

}  // namespace

Illumination read_illumination(const Block& file)
{
    Illumination illumination = Illumination::scratch;
    file.set("illumination", illumination, [](const Field& field) {
        return static_cast<Illumination>(read_choice(field, illuminations));
    });
    return illumination;
}

void build_settings(const Block& file, Scene& scene)
{
    // Note 001 samples its own integer canvas points.
    if (scene.illumination != Illumination::scratch)
        scene.camera.pixel_sample = {0.5, 0.5};
    // Note 000 goes on while depth <= 5, the camera ray being the first.
    if (scene.illumination == Illumination::sketch)
        scene.max_depth = 4;
    file.set("viewport_size", scene.camera.viewport, read_size);
    file.set("projection_plane_d", scene.camera.distance, read_positive);
    file.set("pixel_sample", scene.camera.pixel_sample, read_pixel_sample);
    if (const auto field = file.find("image_size"))
        read_image_size(*field, scene);
    file.set("background", scene.background, read_color);
    file.set("max_depth", scene.max_depth,
             [](const Field& field) { return read_integer(field, 0, deepest); });
    file.set("shadows", scene.shadows, read_shadows);
    if (const auto field = file.find("depth_limit"))
        read_depth_limit(*field, scene);
}

}  // namespace packtrace::reader
