#pragma once

#include <packtrace/scene.hpp>

#include <cstdint>

namespace packtrace {

/// An object that may have moved. Most moved objects are spheres without a transform. They are
/// copied here, because they are read several times and scenes are large.
struct MovedShape {
    std::int32_t object = 0;
    bool plain = false;  ///< a sphere without a transform; others are looked up in the scene
    Sphere sphere{};
};

/// Whether an object is a sphere without a transform.
[[nodiscard]] inline bool is_plain_sphere(const Object& object)
{
    return std::holds_alternative<Sphere>(object.surface) && object.transform == Mat4(1.0);
}

[[nodiscard]] inline MovedShape moved_shape(const Object& object, std::int32_t number)
{
    MovedShape shape{.object = number, .plain = is_plain_sphere(object)};
    if (shape.plain)
        shape.sphere = std::get<Sphere>(object.surface);
    return shape;
}

}  // namespace packtrace
