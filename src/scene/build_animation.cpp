#include "scene/scene_builder.hpp"
#include "scene/unit_vector.hpp"
#include "scene/values.hpp"

#include <glm/geometric.hpp>

#include <string>
#include <vector>

namespace packtrace::reader {
namespace {

constexpr int most_frames = 1'000'000;

bool is_on_axis(const Vec3& position, const Orbit& orbit)
{
    const Vec3 arm = position - orbit.center;
    return arm == Vec3(0.0) ||
           glm::length(glm::cross(unit_vector(orbit.axis), unit_vector(arm))) < 1e-12;
}

Orbit build_orbit(const Field& field, const Camera& camera)
{
    const Block block(field, "orbit", {"center", "axis", "degrees"});
    Orbit orbit;
    orbit.center = read_point(block.require("center", "(0, 0, 3)"));
    block.set("axis", orbit.axis, read_direction);
    block.set("degrees", orbit.degrees, read_number);
    if (is_on_axis(camera.position, orbit))
        field.fail(
            "the camera stands on the orbit's axis, where it would not move; give the camera "
            "another position or the orbit another center");
    return orbit;
}

CameraKey build_key(const Field& field, int frames)
{
    const Block block(field, "key", {"frame", "position", "look_at", "up"});
    CameraKey key;
    key.frame = read_integer(block.require("frame", "0"), 0, frames - 1);
    key.position = read_point(block.require("position", "(0, 0, 0)"));
    key.look_at = read_point(block.require("look_at", "(0, 0, 3)"));
    block.set("up", key.up, read_direction);
    (void)view_rotation(*block.find("look_at"), key.position, key.look_at, key.up);
    return key;
}

std::vector<CameraKey> build_keys(const Block& block, int frames)
{
    std::vector<CameraKey> keys;
    for (const Field& field : block.fields()) {
        if (field.entry.key.text != "key")
            continue;
        const CameraKey key = build_key(field, frames);
        if (!keys.empty() && key.frame <= keys.back().frame)
            field.fail("frame " + std::to_string(key.frame) + " does not come after frame " +
                       std::to_string(keys.back().frame) +
                       " of the key before; write keys in rising order");
        keys.push_back(key);
    }
    return keys;
}

}  // namespace

Animation build_animation(const Field& field, const Camera& camera)
{
    const Block block(field, "animation", {"frames", "orbit"}, {"key"});
    Animation animation;
    animation.frames = read_integer(block.require("frames", "120"), 1, most_frames);
    animation.keys = build_keys(block, animation.frames);
    if (const auto orbit = block.find("orbit"))
        animation.orbit = build_orbit(*orbit, camera);
    if (animation.orbit && !animation.keys.empty())
        field.fail(
            "the animation has an orbit and keys, both of which move the camera; remove "
            "one of them");
    if (!animation.orbit && animation.keys.size() < 2)
        field.fail("the animation moves nothing; add orbit { ... } or two or more key { ... }");
    return animation;
}

}  // namespace packtrace::reader
